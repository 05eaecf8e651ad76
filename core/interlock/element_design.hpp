#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/interlock/cell_equilibrium.hpp"
#include "core/interlock/cell_rate.hpp"

namespace pliant::interlock {

/// A limit that a material is to have: how far `drive`, a load alone, takes it from rest, as load · ε.
struct LimitGoal {
  enum class Kind {
    match,   ///< to be at `wanted`
    atLeast  ///< not to be nearer
  };
  StrainDrive drive;
  double wanted = 0;
  double weight = 1;  ///< of the squared difference
  Kind kind = Kind::match;
};

/// Which elements are looked for, and what for.
struct ElementDesignProblem {
  CellFunction build;
  Eigen::VectorXd start;         ///< numbers of the element
  Eigen::VectorXd lower, upper;  ///< their bounds; equal ones lock a number
  Eigen::VectorXd steps;         ///< see rateOf
  std::vector<LimitGoal> goals;
  double clearance = 0;  ///< smallest gap at rest [m]
  EquilibriumOptions equilibrium;
  double perturbation = 0.01;  ///< see LimitOptions
  unsigned seed = 1;
  int trials = 1;
};

struct ElementDesignOptions {
  int maximumIterations = 40;
  double tolerance = 1e-5;     ///< on the root mean square of the differences to wanted limits, in strain
  double firstStep = 0.2;      ///< largest first change of a number, relative to its range
  double largestStep = 0.5;    ///< the same of any step
  double smallestStep = 1e-6;  ///< below which the search ends
};

/// An element on the way, valid and with all its limits.
struct ElementIterate {
  int iteration = 0;  ///< 0 for the start
  Eigen::VectorXd values;
  Eigen::VectorXd limits;   ///< load · ε, one a goal; infinite where nothing limits it, if that is allowed
  double residual = 0;      ///< root mean square of weighted differences, over the weights' mean
  double clearance = 0;     ///< smallest gap at rest [m], or what was asked for if nothing is that near
  double stationarity = 0;  ///< how much of the residual's square a step is predicted to take away at most, relative
  double stepSize = 0;      ///< largest change of a number, relative to its range
  int evaluations = 0, failures = 0;  ///< so far: of elements whose limits were asked for, and those that had none
  int kinks = 0;                      ///< goals whose derivatives do not hold, see LimitSensitivity
};

/// Why a design ended.
enum class DesignEnd {
  reached,     ///< the limits are those wanted
  stationary,  ///< no small change brings all of them nearer
  kink,  ///< derivatives promise a better element, but steps down to the smallest found none: contacts change here
  other  ///< see the termination
};

struct ElementDesignResult {
  std::vector<ElementIterate> history;  ///< each better than those before it
  base::TerminationType termination = base::TerminationType::failed;
  std::string message;  ///< one sentence if not converged
  DesignEnd end = DesignEnd::other;
  int evaluations = 0, failures = 0;

  const ElementIterate& best() const { return history.back(); }
};

/// Finds numbers of an element whose limits are nearest to those wanted, in the sense of least squares: the
/// Gauss-Newton method within a box-shaped trust region, each step a quadratic program with the numbers' bounds and the
/// linearised gaps at rest; then the gaps themselves are put right. A step to an element that overlaps, is linked
/// otherwise, lacks a limit or is no better only shrinks the region, so that every element kept is valid. Cancellation
/// returns the best so far.
ElementDesignResult designElement(const ElementDesignProblem& problem, const ElementDesignOptions& options,
                                  base::ExecutionContext& context,
                                  const std::function<void(const ElementDesignResult&)>& observe = {});

}  // namespace pliant::interlock
