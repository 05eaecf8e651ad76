#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// Keys of an interlocking cell of type "composed", but for those that all cells have.
std::vector<base::ParameterSpec> composedCellKeys();

}  // namespace pliant::scene
