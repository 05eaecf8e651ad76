#pragma once

#include <vector>

#include "core/math/phases.hpp"

namespace pliant::mechanics {

/// Σ amplitude cos(order θ + phase), with θ the phase of the first or the second driving frequency: a function of the
/// phases alone. The unit is that of the amplitude.
struct PeriodicSignal {
  struct Term {
    int order = 1;
    double amplitude = 0;
    double phase = 0;  ///< rad
    bool ofSecondFrequency = false;
  };
  std::vector<Term> terms;

  double operator()(math::Phases phases) const;
};

}  // namespace pliant::mechanics
