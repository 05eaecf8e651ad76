#pragma once

#include <vector>

namespace pliant::mechanics {

/// Σ amplitude cos(order τ + phase), a function of τ = ωt alone. The unit is that of the amplitude.
struct PeriodicSignal {
  struct Term {
    int order = 1;
    double amplitude = 0;
    double phase = 0;  ///< rad
  };
  std::vector<Term> terms;

  double operator()(double tau) const;
};

}  // namespace pliant::mechanics
