#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// Native patches of thesis Table 4.1 at rest under a point load of 0.5 N, one row each.
base::Json measurePatches();

}  // namespace pliant::bench
