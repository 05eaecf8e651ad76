#pragma once

#include "core/harmonic/inverse_design.hpp"

namespace pliant::harmonic {

/// A design from which the optimiser began, and what it came to.
struct DesignStart {
  Vector values;         ///< of the parameters that may change
  double objective = 0;  ///< there
  double reached = 0;    ///< the lowest that was found from there
  int designs = 0;       ///< accepted on the way
  base::TerminationType termination = base::TerminationType::failed;
};

struct MultiStartResult {
  /// Of the best start. Its history begins with the model's own design, whatever the start, and its counts are of all.
  InverseDesignResult design;
  std::vector<DesignStart> starts;  ///< the first is the model's own design
  int best = 0;                     ///< of the starts
};

/// The best of what `designInversely` finds from several first designs: the model's own and, of four times as many that
/// fill the space between the bounds evenly (sampleDesignSpace), those with the lowest objective. `onIterate` gets the
/// designs of one start after the other, each beginning with iteration 0. On cancellation, the best so far.
MultiStartResult designFromSeveralStarts(const HarmonicBalanceProblem& problem, const DesignObjective& objective,
                                         const InverseDesignOptions& options, int starts, unsigned seed,
                                         base::ExecutionContext& context,
                                         const std::function<void(const DesignIterate&)>& onIterate = {});

}  // namespace pliant::harmonic
