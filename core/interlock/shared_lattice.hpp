#pragma once

#include "core/interlock/unit_cell.hpp"

namespace pliant::interlock {

/// Materials whose elements can stand in for each other on one lattice, as one cell: element i of material m is its
/// element m n + i, of n an element each. At every place of a piece one of them may be, linked to whichever are its
/// neighbours. It is no material itself, since all stand in one place. Throws base::InputError (location empty) if
/// lattices, numbers of elements or links differ.
UnitCell sharedLattice(const std::vector<UnitCell>& materials);

}  // namespace pliant::interlock
