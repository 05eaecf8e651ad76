#pragma once

#include <optional>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// Two elements of which the surface of one, a closed mesh, is crossed by a piece of the other, or encloses it. Their
/// gap, which is a distance of surfaces, does not tell. Nothing is said of pieces that are not closed meshes: where
/// these overlap, gaps are negative.
std::optional<CellContact::ImagePair> overlappingBodies(const CellContact& contact, const CellState& state);

}  // namespace pliant::interlock
