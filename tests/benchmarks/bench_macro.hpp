#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// The sheets of thesis Fig. 4.9 and Table 4.1, and how far they are from the elements that they stand for.
base::Json measureMacro();

}  // namespace pliant::bench
