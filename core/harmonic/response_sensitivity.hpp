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
  /// Uses `factorization` of ∂h/∂z at the solution if the solve left one behind, else factorises once.
  ResponseSensitivity(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                      const math::SparseFactorization* factorization = nullptr);

  /// size() x np.
  const Matrix& derivative() const { return derivative_; }
  /// z + dz/dp Δp (2.4.4), Δp of size np. A few microseconds a parameter.
  Vector predict(const Vector& parameterChange) const;

 private:
  Vector z_;
  Matrix derivative_;
};

}  // namespace pliant::harmonic
