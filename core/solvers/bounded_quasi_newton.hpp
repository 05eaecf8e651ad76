#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// A smooth function of bounded variables.
class BoundedObjective {
 public:
  virtual ~BoundedObjective() = default;
  /// f(x) and its gradient; none where f has no value (a simulation did not converge there). `x` is within the bounds.
  virtual std::optional<double> evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) = 0;
};

struct BoundedQuasiNewtonOptions {
  int maximumIterations = 200;
  int memory = 10;                  ///< corrections that the Hessian is made of
  double gradientTolerance = 1e-6;  ///< on the projected gradient relative to the first one
  double valueTolerance = 1e-9;     ///< two iterations that lower f by less each, relative to |f|, end it
  double firstStep = 0.1;           ///< largest change of a variable that is tried first
  double maximumStep = std::numeric_limits<double>::infinity();  ///< largest change of a variable in an iteration
};

/// An accepted point. The references hold during the call alone.
struct BoundedIterate {
  int iteration;  ///< 0 for the start
  const Eigen::VectorXd& x;
  double value;
  double projectedGradient;  ///< largest component of P(x - ∇f) - x
  double stepLength;         ///< fraction of the quasi-Newton step
  int evaluations;           ///< of f so far
};

/// Minimises f subject to lower <= x <= upper (±infinity allowed; equal bounds fix a variable) by the limited-memory
/// BFGS method with bounds of Byrd, Lu, Nocedal and Zhu (1995): the Hessian as a compact matrix (2.3), the generalised
/// Cauchy point (4.), the minimum over the variables that are free there, projected onto the bounds (Morales and
/// Nocedal 2011), and a line search for the strong Wolfe conditions. A trial point without a value only shortens the
/// step. `x` is the start (put within the bounds) and the answer: the lowest point found, whatever the termination.
/// Records of the report: the projected gradient, the step length and the relative decrease of f. Cancellation is
/// polled before every evaluation.
base::SolverReport minimizeWithinBounds(BoundedObjective& objective, Eigen::VectorXd& x, const Eigen::VectorXd& lower,
                                        const Eigen::VectorXd& upper, const BoundedQuasiNewtonOptions& options,
                                        base::ExecutionContext& context,
                                        const std::function<void(const BoundedIterate&)>& onIterate = {});

}  // namespace pliant::solvers
