#pragma once

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// Where the same two elements are near at places within `apart` [m] of each other, the nearest counts alone: parts of
/// a curve that meet near a contact each have a share in it. Sorted by their gaps.
std::vector<CellContactForce> distinctContacts(std::vector<CellContactForce> contacts, double apart);

/// The contacts of a state of which only the places of the elements are known: those nearer than `range` [m]. Forces
/// are in proportion to each other as those of a barrier of that range are.
std::vector<CellContactForce> holdingContacts(const CellContact& contact, const CellState& state, double range);

}  // namespace pliant::interlock
