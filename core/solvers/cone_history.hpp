#pragma once

#include <deque>
#include <optional>

#include "core/solvers/cone_elements.hpp"
#include "core/solvers/cone_objective.hpp"

namespace pliant::solvers {

/// The multipliers of the last projections, to start the next one from. Those of the last are not always the ones that
/// fit: reflected motion overshoots and comes back, and resembles what it was two steps (four projections) ago.
class ConeHistory {
 public:
  void clear() { entries_.clear(); }
  void remember(ConeElements::Multipliers multipliers, double objective);

  /// The objective of the last projection that is remembered, 0: none is.
  double lastObjective() const { return entries_.empty() ? 0 : entries_.front().objective; }

  struct Match {
    const ConeElements::Multipliers* multipliers;
    double factor;
    double bound;  ///< D: the objective is at least this
  };
  /// The multipliers, and the multiple of them, that prove the largest bound on the projection of `candidate`, by their
  /// forces at x (both 3 x nodes); none if none proves any.
  std::optional<Match> bestFor(const ConeElements& elements, const ConeObjective& objective, const Positions& x,
                               const Positions& candidate) const;

 private:
  static constexpr std::size_t length = 4;

  struct Entry {
    ConeElements::Multipliers multipliers;
    double objective;
  };
  std::deque<Entry> entries_;  ///< the last first
};

}  // namespace pliant::solvers
