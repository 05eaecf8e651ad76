#pragma once

#include <optional>
#include <vector>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// What numbers of a measured coordinate mean.
enum class MeasuredValue {
  position,      ///< in the scene's frame
  displacement,  ///< from where the node rests
  swing          ///< from a place that is not known, one a coordinate, which is estimated
};

/// One coordinate of a node over time.
struct MeasuredCoordinate {
  int node = 0;
  int axis = 0;
  Vector values;  ///< [m], an entry each instant; NaN where there is none
};

/// A steady motion that was measured at one driving frequency.
struct MeasuredMotion {
  double omega = 0;  ///< [rad/s]
  Vector times;      ///< [s]
  std::vector<MeasuredCoordinate> coordinates;
  MeasuredValue meaning = MeasuredValue::position;
  /// The drive is at τ = ω (time + timeOffset). Estimated, one for all coordinates, if there is none.
  std::optional<double> timeOffset;

  int sampleCount() const;
  /// Of the time offset and the places that are estimated.
  int unknownCount() const;
};

/// A motion beside a measured one. Rows are samples, coordinate after coordinate, those without a value left out.
struct MotionFit {
  double phase = 0;  ///< ω timeOffset; in [0, 2π) if estimated
  Vector fitted;     ///< what the model gives, in the terms of the measured values [m]
  Vector residuals;  ///< fitted minus measured [m]
  Vector byPhase;    ///< ∂r/∂φ, estimated places projected out; empty if the time offset is known
};

/// Compares motions with a measured one: r = x(ωt + φ) - measured. The phase φ, where it is not known, is that of the
/// least Σ r², of all; unknown places are means of x - measured. So r depends on the motion alone, and its derivative
/// is taken with both held and projected off what they could change (variable projection in Kaufman's form, 1975): the
/// gradient of Σ r² is exact, and so are Gauss-Newton steps and covariances of all unknowns together.
class MotionComparison {
 public:
  MotionComparison(MeasuredMotion measured, int harmonics);

  const MeasuredMotion& measured() const { return measured_; }
  /// `coefficients`: (2H+1) x measured coordinates, in the terms of the measured values [m].
  MotionFit compare(const Matrix& coefficients) const;
  /// ∂r/∂p at a comparison, from that of the coefficients by a parameter; `projected` off what the estimated phase and
  /// places could change.
  Vector derivative(const MotionFit& at, const Matrix& coefficientDerivative, bool projected = true) const;

 private:
  Vector synthesis(const Matrix& coefficients, double phase) const;
  void removePlaces(Vector& rows) const;
  double bestPhase(const Matrix& coefficients) const;

  MeasuredMotion measured_;
  int size_;                         ///< 2H+1
  std::vector<Matrix> instants_;     ///< of each coordinate: samples x (2H+1), values of the basis at ωt
  std::vector<Matrix> grams_;        ///< of those, places projected out
  std::vector<Vector> projections_;  ///< of the measured values onto them
  Vector values_;                    ///< measured, in order of rows
};

}  // namespace pliant::harmonic
