#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// In-plane boundaries of the four materials of thesis 4.4.2, on one thread and on all, with what every Newton
/// iteration of them costs. Rows also hold the largest gap over the wire radius and the largest remaining strain.
base::Json measureInterlock();

}  // namespace pliant::bench
