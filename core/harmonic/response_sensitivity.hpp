#pragma once

#include <memory>
#include <vector>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/periodic_motion.hpp"

namespace pliant::harmonic {

/// First-order dependence of one periodic motion on the model's design parameters (2.4.3):
/// dz/dp = -(∂h/∂z)⁻¹ ∂h/∂p, one column a parameter of `Model::parameters`.
class ResponseSensitivity {
 public:
  /// Solves with the factors that `motion` carries, refined against the exact ∂h/∂z at the solution; factorises once
  /// where there are none or they are too far off. All zero if ∂h/∂z is singular (at a fold); see `regular`.
  ResponseSensitivity(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion);

  /// False if the motion stands at a fold, where it has no derivative.
  bool regular() const { return regular_; }
  /// size() x np.
  const Matrix& derivative() const { return derivative_; }
  /// z + dz/dp Δp (2.4.4), Δp of size np. A few microseconds a parameter.
  Vector predict(const Vector& parameterChange) const;

 private:
  Vector z_;
  Matrix derivative_;
  bool regular_ = true;
};

}  // namespace pliant::harmonic
