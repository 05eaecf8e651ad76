#pragma once

#include <vector>

#include "core/harmonic/response_sensitivity.hpp"

namespace pliant::harmonic {

/// Values of one parameter, the others as they are.
struct ParameterRange {
  double lower = 0;
  double upper = 0;
};

/// Derivatives of the motions at p + s d by s, at s = 0; size() each.
struct MotionDerivatives {
  Vector first, second, third;
};

/// How far the predictions of a ResponseSensitivity can be trusted: their error is second order in the change of the
/// parameters, and its leading terms cost one solve each with the same factors.
///
/// Along p + s d, the motions obey h(z(s), p + s d) = 0. Differentiated twice and three times,
///   ∂h/∂z z'' = -d²/ds² h(z + s z', p + s d),  ∂h/∂z z''' = -d³/ds³ h(z + s z' + ½ s² z'', p + s d),  z' = dz/dp d.
/// The right-hand sides are differences of three and of six residuals (one more where the parameters do not reach to
/// both sides). The first is exact for elastic forces that are cubic in the positions, such as those of membranes and
/// solids.
class PredictionError {
 public:
  /// `sensitivity` must be that of `motion`. Evaluates ∂h/∂z once; factorises it only if `motion` carries no factors
  /// near it.
  PredictionError(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                  const ResponseSensitivity& sensitivity);

  /// False if ∂h/∂z is singular, at a fold: nothing else may be asked then.
  bool regular() const { return factors_ != nullptr; }
  /// Along `direction` (size np) up to this order, 1 to 3; those above it are empty. Throws base::InputError if the
  /// parameters end close by on both sides.
  MotionDerivatives derivatives(const Vector& direction, int order) const;
  /// The motion at p + Δp by its Taylor series up to this order, 1 to 3.
  Vector predict(const Vector& parameterChange, int order) const;
  /// ‖z + dz/dp Δp - z(p + Δp)‖ to second order, ½ ‖z''‖ along Δp, over the norm of the motion's oscillation.
  double estimate(const Vector& parameterChange) const;
  /// The values of one parameter, within its bounds, up to which first-order predictions err by less than `share` of
  /// the oscillation: by ½ ‖z''‖ Δp² / (1 - q |Δp|), q = ‖z'''‖ / (3 ‖z''‖), as if all terms of the Taylor series
  /// shrank like its second and third. Cautious on the side where they alternate; near a fold, where they shrink
  /// slowly, a motion may be somewhat farther off.
  ParameterRange trustedRange(int parameter, double share) const;
  /// The same of many at once: how often `direction` (size np, not 0) may be gone, the parameters' bounds aside.
  /// Infinite if predictions along it are exact to second order.
  double trustedReach(const Vector& direction, double share) const;

 private:
  double step(const Vector& direction, const Vector& tangent) const;
  Vector residualAt(const Vector& direction, const MotionDerivatives& path, double s) const;
  Vector nextDerivative(const Vector& direction, const MotionDerivatives& path) const;

  HarmonicBalanceProblem problem_;
  double omega_;
  Vector z_;
  Matrix derivative_;
  double swing_;
  SparseMatrix jacobian_;
  std::shared_ptr<const math::SparseFactorization> factors_;  ///< of a matrix near jacobian_
};

}  // namespace pliant::harmonic
