#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// Table 3.1 of the thesis: projections onto stretch limits, Newton's method of implicit Euler, and the other methods
/// of projection, on a square sheet that swings from two corners; with the thesis's seconds beside. One thread.
base::Json measureCloth();

}  // namespace pliant::bench
