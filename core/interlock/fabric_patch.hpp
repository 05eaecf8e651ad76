#pragma once

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// An element of a cell and the lattice vectors by which it is moved.
struct PatchElement {
  int element = 0;
  std::array<int, 2> shift{};

  friend bool operator==(const PatchElement&, const PatchElement&) = default;
  friend bool operator<(const PatchElement& x, const PatchElement& y) {
    return std::tie(x.shift, x.element) < std::tie(y.shift, y.element);
  }
};

/// A piece of a material: elements that hang together by their links.
struct FabricPatch {
  std::vector<PatchElement> elements;  ///< sorted
  int leftOut = 0;                     ///< elements inside the outline that are not linked to those
};

/// `first` x `second` whole cells. Throws base::InputError (location empty) if either is not above 0.
FabricPatch patchOfCells(const UnitCell& cell, int first, int second);

/// All elements whose origins are inside a closed polygon (2 x n, corners in order) [m] in the plane, where the state
/// puts them; the material's origin is at the middle of the polygon's box. Of groups that are not linked to one another
/// the largest remains. Throws base::InputError (location empty) if the polygon has less than three corners, one that
/// is not finite, or no area, or if no element is inside, or more than a million.
FabricPatch patchInside(const UnitCell& cell, const CellState& state, const Eigen::Matrix2Xd& polygon);

/// Of these elements the largest group that links hold together; of several the first.
FabricPatch linkedPatch(const UnitCell& cell, std::vector<PatchElement> elements);

/// A rectangle of these sides and a circle, as a polygon of 256 corners, around the origin [m].
Eigen::Matrix2Xd rectangleOutline(double width, double height);
Eigen::Matrix2Xd circleOutline(double diameter);

/// Where the origin of an element is [m].
Eigen::Vector3d placeOf(const UnitCell& cell, const CellState& state, const PatchElement& element);

/// The smallest distance between surfaces of different elements of the endless material [m], exact.
double clearance(const UnitCell& cell, const CellState& state);

}  // namespace pliant::interlock
