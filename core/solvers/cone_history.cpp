#include "core/solvers/cone_history.hpp"

#include <utility>

namespace pliant::solvers {

void ConeHistory::remember(ConeElements::Multipliers multipliers, double objective) {
  entries_.push_front({std::move(multipliers), objective});
  if (entries_.size() > length) entries_.pop_back();
}

std::optional<ConeHistory::Match> ConeHistory::bestFor(const ConeElements& elements, const ConeObjective& objective,
                                                       const Positions& x, const Positions& candidate) const {
  std::optional<Match> best;
  Positions forces(3, x.cols());
  for (const Entry& entry : entries_) {
    forces.setZero();
    const double supportGap = elements.addForces(entry.multipliers, x, forces);
    // D(t) = t gain - ½ t² squared for the multiple t.
    const double gain = (forces.array() * (candidate - x).array()).sum() - supportGap;
    const double squared = objective.inverseNorm(forces);
    if (!(gain > 0 && squared > 0)) continue;
    const double bound = 0.5 * gain * gain / squared;
    if (!best || bound > best->bound) best = {&entry.multipliers, gain / squared, bound};
  }
  return best;
}

}  // namespace pliant::solvers
