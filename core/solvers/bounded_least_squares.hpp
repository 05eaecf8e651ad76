#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// Residuals of bounded variables.
class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  /// r(x), of any constant size, and ∂r/∂x unless `jacobian` is null; false where there are none (a simulation did not
  /// converge there). `x` is within the bounds. The Jacobian is asked for at points whose residuals were asked for
  /// right before, when they are accepted.
  virtual bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) = 0;
};

struct BoundedLeastSquaresOptions {
  int maximumIterations = 100;
  double gradientTolerance = 1e-8;  ///< on the largest cosine between residuals and a column that bounds leave free
  double valueTolerance = 1e-12;    ///< on the foretold decrease of ‖r‖², relative to it
  double stepTolerance = 1e-12;     ///< on the largest change of a variable
  double firstDamping = 1e-3;       ///< λ, of columns scaled to length 1
  double maximumStep = std::numeric_limits<double>::infinity();  ///< largest change of a variable in an iteration
};

/// An accepted point. The references hold during the call alone.
struct LeastSquaresIterate {
  int iteration;  ///< 0 for the start
  const Eigen::VectorXd& x;
  const Eigen::VectorXd& residuals;
  const Eigen::MatrixXd& jacobian;
  double cosine;    ///< the largest between the residuals and a column that the bounds leave free
  double damping;   ///< λ of the step that led here
  int evaluations;  ///< of r so far
};

/// Minimises ½ ‖r(x)‖² subject to lower <= x <= upper (±infinity allowed; equal bounds fix a variable) by the method of
/// Levenberg (1944) and Marquardt (1963): steps solve min ½ ‖r + J d‖² + ½ λ ‖D d‖² within the bounds, exactly, by an
/// active set (leastSquaresWithinBounds); D holds the longest columns of J so far (Moré 1978) and λ follows how well
/// the decrease was foretold (Nielsen 1999). A trial point without residuals raises λ. `x` is the start (put within the
/// bounds) and the answer: the lowest point found, whatever the termination. Records of the report: the cosine, 1 for
/// an accepted step, and the relative decrease of ‖r‖². Cancellation is polled before every evaluation.
base::SolverReport fitWithinBounds(ResidualFunction& function, Eigen::VectorXd& x, const Eigen::VectorXd& lower,
                                   const Eigen::VectorXd& upper, const BoundedLeastSquaresOptions& options,
                                   base::ExecutionContext& context,
                                   const std::function<void(const LeastSquaresIterate&)>& onIterate = {});

/// The x that minimises ‖A x - b‖ subject to lower <= x <= upper, which hold 0, for A of full column rank: the active
/// set method of Stark and Parker (1995), begun at 0.
Eigen::VectorXd leastSquaresWithinBounds(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                         const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace pliant::solvers
