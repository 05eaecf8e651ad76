#pragma once

#include <Eigen/Core>

namespace pliant::math {

/// The truncated Fourier basis 1, sin τ, cos τ, ..., sin Hτ, cos Hτ (sine first, thesis 2.A.3) with N uniform samples
/// τ_i = 2π i / N, i = 0 .. N-1. Everything is a function of τ = ωt, so nothing here depends on the frequency.
class HarmonicBasis {
 public:
  /// Throws std::invalid_argument unless harmonics >= 0 and samples >= 2 harmonics + 1.
  HarmonicBasis(int harmonics, int samples);

  int harmonics() const { return harmonics_; }
  int samples() const { return samples_; }
  /// Number of coefficients, 2H + 1.
  int size() const { return 2 * harmonics_ + 1; }

  /// Γ, N x (2H+1): coefficients to samples (2.A.17).
  const Eigen::MatrixXd& synthesis() const { return synthesis_; }
  /// Left inverse of Γ, (2H+1) x N: samples to coefficients (2.A.18; the constant row has the factor 1/N).
  const Eigen::MatrixXd& analysis() const { return analysis_; }

  /// d/dτ of the columns of coefficients, (2H+1) x m: sine coefficient -k c_k, cosine coefficient +k s_k.
  Eigen::MatrixXd derivative(const Eigen::MatrixXd& coefficients) const;
  /// Second derivative in τ: every coefficient of harmonic k times -k².
  Eigen::MatrixXd secondDerivative(const Eigen::MatrixXd& coefficients) const;

  /// 1, sin τ, cos τ, ... at any τ (radians): a vector of size 2H+1.
  Eigen::VectorXd valuesAt(double tau) const;

 private:
  int harmonics_;
  int samples_;
  Eigen::MatrixXd synthesis_;
  Eigen::MatrixXd analysis_;
};

}  // namespace pliant::math
