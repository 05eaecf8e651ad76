#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/math/phases.hpp"

namespace pliant::math {

/// A truncated Fourier basis: 1 and the sines and cosines of some combinations of phases (sine first, thesis 2.A.3),
/// with samples that determine its coefficients. Everything is a function of τ, so nothing here depends on ω.
///
/// Of one frequency: 1, sin τ, cos τ, ..., sin Hτ, cos Hτ with N uniform samples τ_i = 2π i / N, i = 0 .. N-1.
///
/// Of two frequencies ω and r ω without a common period (quasi-periodic motions; Chua and Ushida 1981, Kim and Choi
/// 1997): 1 and the sines and cosines of k₁ θ₁ + k₂ θ₂ with |k₁| + |k₂| <= H, a half of these pairs (k₁ > 0, or k₁ = 0
/// and k₂ > 0), by rising |k₁| + |k₂|, so that fewer orders are the first coefficients of more. Coefficients of smooth
/// motions fall with |k₁| + |k₂|, which is why the pairs fill a diamond and not a square of twice as many. Samples are
/// a grid of N x N points of the torus (θ₁, θ₂). In time a motion runs along θ₁ = ν τ, θ₂ = ν r τ: τ from 0 to 2π takes
/// `periods()` = ν periods of the first frequency, after which the motion does not repeat but comes close.
class HarmonicBasis {
 public:
  /// Throws std::invalid_argument unless harmonics >= 0 and samples >= 2 harmonics + 1.
  HarmonicBasis(int harmonics, int samples);
  /// Of two frequencies; `order`: H; `samples`: N; `ratio`: r. `periods`: those of the first one in 2π of τ; 0 for
  /// those of at most 32 after which the second one is nearest to the end of a period. Throws std::invalid_argument
  /// unless order >= 0, samples >= 2 order + 1, 0 < ratio < infinity, periods >= 0.
  static HarmonicBasis ofTwoFrequencies(int order, int samples, double ratio, int periods = 0);

  /// H: the largest order, |k₁| + |k₂|.
  int order() const { return order_; }
  /// Number of pairs of sine and cosine: H of one frequency.
  int harmonics() const { return static_cast<int>(combinations_.size()); }
  /// Number of coefficients, 2 harmonics() + 1.
  int size() const { return 2 * harmonics() + 1; }
  /// Number of all samples.
  int samples() const { return samplesOfPeriod_ * (hasTwoFrequencies() ? samplesOfPeriod_ : 1); }
  /// N, of a period of each frequency.
  int samplesOfPeriod() const { return samplesOfPeriod_; }

  bool hasTwoFrequencies() const { return ratio_ > 0; }
  /// The second frequency divided by the first; 0 if there is none.
  double ratio() const { return ratio_; }
  int periods() const { return periods_; }
  /// k₁ and k₂ of pair k = 1 .. harmonics().
  std::array<int, 2> combination(int k) const { return combinations_[static_cast<std::size_t>(k) - 1]; }
  /// The rate of its phase: ν (k₁ + k₂ r), and k of one frequency.
  double rate(int k) const { return rates_[static_cast<std::size_t>(k) - 1]; }
  /// θ₁ and θ₂ at a sample.
  Phases samplePhases(int sample) const;
  /// k₁ θ₁ + k₂ θ₂ at a sample but for whole turns.
  double samplePhase(std::array<int, 2> combination, int sample) const;
  /// All pairs with |k₁| + |k₂| <= `order` as they stand in a basis like this: first those of this basis if it has a
  /// lower order.
  std::vector<std::array<int, 2>> combinations(int order) const;

  /// Γ, samples x size: coefficients to samples (2.A.17).
  const Eigen::MatrixXd& synthesis() const { return synthesis_; }
  /// Left inverse of Γ, size x samples: samples to coefficients (2.A.18; the constant row has the factor 1/N).
  const Eigen::MatrixXd& analysis() const { return analysis_; }

  /// d/dτ of the columns of coefficients, size x m: sine coefficient -rate c_k, cosine coefficient +rate s_k.
  Eigen::MatrixXd derivative(const Eigen::MatrixXd& coefficients) const;
  /// Second derivative in τ: every coefficient of pair k times -rate².
  Eigen::MatrixXd secondDerivative(const Eigen::MatrixXd& coefficients) const;

  /// The functions of the basis at any τ: size.
  Eigen::VectorXd valuesAt(double tau) const;
  /// The functions of the basis at any phases: size.
  Eigen::VectorXd valuesAtPhases(Phases phases) const;

 private:
  HarmonicBasis(int order, int samples, double ratio, int periods);

  int order_;
  int samplesOfPeriod_;
  double ratio_;
  int periods_;
  std::vector<std::array<int, 2>> combinations_;
  std::vector<double> rates_;
  Eigen::MatrixXd synthesis_;
  Eigen::MatrixXd analysis_;
};

}  // namespace pliant::math
