#pragma once

#include <limits>

#include "core/geometry/simplex_distance.hpp"

namespace pliant::geometry {

/// A fraction t in (0, limit] of the motion such that the two simplices with corners `corners` + τ `motion` [m] stay
/// farther apart than `separation` [m] for all τ from 0 to t. It is `limit` if they do so all the way; otherwise no
/// more of the gap (distance - separation) is left at t than a tenth of that at τ = 0, nor than `keptGap` [m]. 0 if
/// there is no gap to begin with (or none beyond rounding), or if an input is not finite.
///
/// Additive advancement (Li, Kaufman & Jiang 2021, "Codimensional incremental potential contact", algorithm 1): each
/// advance uses up nine tenths of the current gap, divided by a bound of the speed of approach, hence never passes a
/// collision. Gap and speed are those along the direction n between the closest points: for any n,
/// min n·x_A - max n·x_B bounds the distance from below at all times, and changes no faster than its corners do. So an
/// inaccurate n does no harm, and simplices that slide past each other need few advances.
double safeFraction(SimplexPair pair, const Corners& corners, const Corners& motion, double separation,
                    double limit = 1, double keptGap = std::numeric_limits<double>::infinity());

}  // namespace pliant::geometry
