#pragma once

#include "core/cloth/stretch_limit.hpp"

namespace pliant::cloth {

/// The largest stretch sqrt(dᵀSd) that the ellipses of a limit allow along α, each alone: the lower envelope. Infinite
/// where there is none.
double envelopeStretch(const LimitConstraints& constraints, double angle);

/// The largest b over all directions.
double largestStretch(const StretchLimit& limit);

}  // namespace pliant::cloth
