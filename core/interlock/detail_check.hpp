#pragma once

#include "core/interlock/fabric_patch.hpp"

namespace pliant::interlock {

/// What of a placed piece of a material holds, found without the contact that placed it.
struct DetailCheck {
  long pairs = 0;      ///< of elements near enough to touch or be linked
  long links = 0;      ///< pairs of loops that the material links, both in the piece
  long lostLinks = 0;  ///< of these, whose Gauss linking number is another one
  long newLinks = 0;   ///< pairs of loops that are linked, and not in the material
  /// No two elements are nearer than this [m]: wires are replaced by polygons, whose chords' heights are subtracted
  /// from the distances of their sides. Negative where elements may overlap; `reach` if none is that near.
  double smallestDistance = 0;

  bool holds() const { return lostLinks == 0 && newLinks == 0 && smallestDistance > 0; }
};

/// Elements of a material at places of their own. Distances above `reach` [m] are not told apart.
DetailCheck checkDetail(const UnitCell& cell, const std::vector<PatchElement>& elements, const CellState& state,
                        double reach);

}  // namespace pliant::interlock
