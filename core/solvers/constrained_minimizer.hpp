#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// A point of a constrained problem.
struct ConstrainedValue {
  double objective = 0;
  Eigen::VectorXd constraints;  ///< g(x), m of them
  Eigen::VectorXd gradient;     ///< ∇f; empty unless asked for
  Eigen::MatrixXd jacobian;     ///< m x n, ∂g/∂x
};

/// A smooth function of bounded variables with smooth constraints.
class ConstrainedFunction {
 public:
  virtual ~ConstrainedFunction() = default;
  /// None where there is no value (a simulation did not converge there). `x` is within the bounds. Derivatives are
  /// asked for at points whose values were asked for right before.
  virtual std::optional<ConstrainedValue> evaluate(const Eigen::VectorXd& x, bool withDerivatives) = 0;
};

struct ConstrainedBounds {
  Eigen::VectorXd lower, upper;                      ///< of the variables
  Eigen::VectorXd constraintLower, constraintUpper;  ///< of g; ±infinity allowed, equal ones make an equation
};

struct ConstrainedOptions {
  int maximumIterations = 200;
  double tolerance = 1e-6;            ///< on Ipopt's scaled error of the optimality conditions
  double constraintTolerance = 1e-6;  ///< by how much g may break its bounds for a point to count as feasible
};

/// How well the optimality conditions (Karush, Kuhn, Tucker) hold at a point, found without the optimiser: multipliers
/// of the right signs for what is at its bound, by least squares.
struct Optimality {
  double stationarity = 0;      ///< largest component of ∇f + Jᵀ λ + μ, over the largest of ∇f
  double violation = 0;         ///< largest by which g breaks a bound
  Eigen::VectorXd multipliers;  ///< λ of g: positive at upper bounds, negative at lower ones
};

/// What is within `activeTolerance` of its bound counts as at it.
Optimality optimalityOf(const ConstrainedValue& at, const Eigen::VectorXd& x, const ConstrainedBounds& bounds,
                        double activeTolerance = 1e-4);

/// An accepted iterate, not always better than the one before. The references hold during the call alone.
struct ConstrainedIterate {
  int iteration;  ///< 0 for the start
  const Eigen::VectorXd& x;
  const ConstrainedValue& value;
  double violation;
  double stepLength;
  int evaluations;
};

struct ConstrainedSolution {
  base::SolverReport report;  ///< residuals: Ipopt's scaled dual infeasibility; corrections: the violation
  Eigen::VectorXd x;       ///< the answer if converged, else the best feasible point met, or the least infeasible one
  ConstrainedValue value;  ///< with derivatives
  Optimality optimality;
  int evaluations = 0;
};

/// Minimises f subject to bounds of x and g by Ipopt, an interior-point method with a filter line search (Wächter and
/// Biegler 2006), its Hessian approximated by limited-memory BFGS. Points without a value shorten the step. Ipopt
/// starts a little inside the bounds of x. An exception thrown by `function` is passed on. Cancellation is polled
/// before every evaluation. `infeasible` if it ends at a point that breaks constraints with no way to break them less
/// nearby.
ConstrainedSolution minimizeWithConstraints(ConstrainedFunction& function, const Eigen::VectorXd& start,
                                            const ConstrainedBounds& bounds, const ConstrainedOptions& options,
                                            base::ExecutionContext& context,
                                            const std::function<void(const ConstrainedIterate&)>& onIterate = {});

}  // namespace pliant::solvers
