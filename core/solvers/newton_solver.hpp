#pragma once

#include <Eigen/Core>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// A square nonlinear system r(x) = 0 with its linearisation.
class NonlinearSystem {
 public:
  virtual ~NonlinearSystem() = default;
  virtual Eigen::VectorXd residual(const Eigen::VectorXd& x) = 0;
  /// r(x), and prepares solve() with the Jacobian at x. Returns false if the Jacobian is singular.
  virtual bool linearize(const Eigen::VectorXd& x, Eigen::VectorXd& residual) = 0;
  /// (∂r/∂x)⁻¹ b at the x last linearised.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) = 0;
};

/// Where stiff and soft directions meet, rounding keeps ‖r‖ from falling as far as one would like long after x has
/// stopped changing, so convergence also shows in the corrections of x.
struct NewtonOptions {
  double tolerance = 1e-9;  ///< on ‖r‖ / residualScale
  double residualScale = 1;
  double stepScale = 1;             ///< size of x, or of what is to be found of it
  double stepTolerance = 1e-10;     ///< on the correction that remains after a full step, relative to stepScale
  double roundingTolerance = 1e-7;  ///< a step below this, relative to stepScale, that improves nothing is rounding
  int maximumIterations = 40;
  double shortestStep = 1.0 / 64;  ///< of the full step; a line search that asks for less has failed
};

/// Newton's method with a backtracking line search. A step is accepted if it lowers ‖r‖, or if it lowers the correction
/// that the same Jacobian makes of the new residual (the natural monotonicity test of Deuflhard 2004, which does not
/// depend on how the equations are scaled). A trial point where r is not finite only shortens the step. `x` is the
/// start and the answer (the last accepted point if it did not converge). One record an iteration, with the scaled
/// residual and the correction ‖J⁻¹ r‖ / stepScale there (of the last one with the factors of the one before).
/// Cancellation is polled in every iteration.
base::SolverReport solveNewton(NonlinearSystem& system, Eigen::VectorXd& x, const NewtonOptions& options,
                               base::ExecutionContext& context);

}  // namespace pliant::solvers
