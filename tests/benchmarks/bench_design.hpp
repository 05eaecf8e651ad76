#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// Table 2.1: the inverse designs of the thesis, with its columns and ours beside them.
base::Json measureDesign();

}  // namespace pliant::bench
