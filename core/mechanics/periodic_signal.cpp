#include "core/mechanics/periodic_signal.hpp"

#include <cmath>

namespace pliant::mechanics {

double PeriodicSignal::operator()(math::Phases phases) const {
  double sum = 0;
  for (const Term& term : terms)
    sum += term.amplitude * std::cos(term.order * (term.ofSecondFrequency ? phases.second : phases.first) + term.phase);
  return sum;
}

}  // namespace pliant::mechanics
