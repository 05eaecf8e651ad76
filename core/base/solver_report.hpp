#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pliant::base {

/// How an iterative computation ended.
enum class TerminationType { converged, iterationLimit, infeasible, cancelled, failed };

/// "converged", "iteration limit", "infeasible", "cancelled", "failed".
std::string_view toString(TerminationType termination);

/// One iteration of a solver.
struct IterationRecord {
  int iteration = 0;
  double residual = 0;    ///< norm that the solver drives to zero, in the units its documentation states
  double stepLength = 0;  ///< accepted fraction of the full step (0 for the starting point)
  double correction = 0;  ///< how far the answer is still off, to first order, relative to its size
};

/// What every solver returns beside its answer.
struct SolverReport {
  TerminationType termination = TerminationType::failed;
  std::string message;  ///< one sentence; empty if converged
  std::vector<IterationRecord> iterations;
  double seconds = 0;

  bool converged() const { return termination == TerminationType::converged; }
  double residual() const { return iterations.empty() ? 0.0 : iterations.back().residual; }
  double correction() const { return iterations.empty() ? 0.0 : iterations.back().correction; }
};

}  // namespace pliant::base
