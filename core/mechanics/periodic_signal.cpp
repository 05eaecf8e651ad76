#include "core/mechanics/periodic_signal.hpp"

#include <cmath>

namespace pliant::mechanics {

double PeriodicSignal::operator()(double tau) const {
  double sum = 0;
  for (const Term& term : terms) sum += term.amplitude * std::cos(term.order * tau + term.phase);
  return sum;
}

}  // namespace pliant::mechanics
