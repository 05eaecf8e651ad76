#pragma once

#include <vector>

#include "core/interlock/unit_cell.hpp"

namespace pliant::render {

/// For each element one of a few tints, such that linked ones differ where that many are enough.
std::vector<int> elementTints(const interlock::UnitCell& patch, int tints);

}  // namespace pliant::render
