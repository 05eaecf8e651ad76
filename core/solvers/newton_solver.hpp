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

struct NewtonOptions {
  double tolerance = 1e-9;  ///< on ‖r‖ / residualScale
  double residualScale = 1;
  /// A full step with ‖Δx‖ <= stepTolerance * stepScale ends the iteration as converged as well: where stiff and soft
  /// directions meet, rounding keeps ‖r‖ from falling as far as `tolerance` asks long after x has stopped changing.
  double stepTolerance = 1e-12;
  double stepScale = 1;
  int maximumIterations = 40;
};

/// Newton's method with a backtracking line search on ‖r‖². `x` is the start and the answer (the best point if it did
/// not converge). One record an iteration, with the scaled residual. A trial point where r is not finite only shortens
/// the step. Cancellation is polled in every iteration.
base::SolverReport solveNewton(NonlinearSystem& system, Eigen::VectorXd& x, const NewtonOptions& options,
                               base::ExecutionContext& context);

}  // namespace pliant::solvers
