#pragma once

#include "core/harmonic/constrained_design.hpp"

namespace pliant::harmonic {

/// A design from which the optimiser began, and what it came to.
struct DesignStart {
  Vector values;         ///< of the parameters that may change
  double objective = 0;  ///< there
  double reached = 0;    ///< the lowest that was found from there
  double violation = 0;  ///< of the constraints by what was found, in units of their scales
  int designs = 0;       ///< accepted on the way
  base::TerminationType termination = base::TerminationType::failed;
};

struct MultiStartResult {
  /// Of the best start. Its history begins with the model's own design, whatever the start, and its counts are of all.
  /// Without constraints, it has the design alone.
  ConstrainedDesignResult found;
  std::vector<DesignStart> starts;  ///< the first is the model's own design
  int best = 0;                     ///< of the starts
};

/// The best of what `designInversely`, or with constraints `designWithConstraints`, finds from several first designs:
/// the model's own and, of four times as many that fill the space between the bounds evenly (sampleDesignSpace), the
/// best. A design that keeps the constraints (to constraintTolerance) is better than one that does not; of those that
/// do, the lower objective is better, of the others the smaller violation. `onIterate` gets the designs of one start
/// after the other, each beginning with iteration 0. On cancellation, the best so far.
MultiStartResult designFromSeveralStarts(const HarmonicBalanceProblem& problem, const DesignObjective& objective,
                                         const std::vector<DesignConstraint>& constraints,
                                         const InverseDesignOptions& options, int starts, unsigned seed,
                                         base::ExecutionContext& context,
                                         const std::function<void(const DesignIterate&)>& onIterate = {});

}  // namespace pliant::harmonic
