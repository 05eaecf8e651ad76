#pragma once

#include <functional>
#include <optional>

namespace pliant::solvers {

/// A function and its derivative along a line.
struct LineValue {
  double value = 0;
  double slope = 0;
};

/// Finds a step t in (0, longest] with φ(t) <= φ(0) + 1e-4 t φ'(0) and |φ'(t)| <= 0.9 |φ'(0)|, beginning at `first`, by
/// bracketing and cubic interpolation (Nocedal & Wright 2006, algorithms 3.5 and 3.6). `evaluate` gives φ at a step, or
/// none where it has no value, which shortens the step. Returns the step, evaluated last; where the second condition is
/// out of reach (a bound, rounding, or the edge of where φ has values) the best step found with the first, evaluated
/// last as well; none if there is none.
std::optional<double> searchWolfe(const std::function<std::optional<LineValue>(double)>& evaluate, LineValue start,
                                  double first, double longest);

}  // namespace pliant::solvers
