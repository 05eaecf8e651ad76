#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "core/interlock/dilated_piece.hpp"

namespace pliant::interlock {

/// A rigid element of a cell: its shape turned and moved.
struct InterlockingElement {
  int shape = 0;             ///< index in UnitCell::shapes
  Eigen::Vector3d position;  ///< of the shape's origin [m]
  Eigen::Matrix3d rotation;  ///< from the shape's coordinates
};

/// Closed pieces `pieceA` of element `a` and `pieceB` of element `b`, the latter moved by whole lattice vectors, are
/// linked `number` times (Gauss linking number, with its sign). A piece that is a closed mesh may have several handles,
/// see handleCycles; any other has one at most.
struct Link {
  int a = 0, pieceA = 0, b = 0, pieceB = 0;
  std::array<int, 2> shift{};
  int number = 0;
  int handleA = 0, handleB = 0;

  friend bool operator==(const Link&, const Link&) = default;
  friend bool operator<(const Link& x, const Link& y) {
    return std::tie(x.a, x.pieceA, x.handleA, x.b, x.pieceB, x.handleB, x.shift, x.number) <
           std::tie(y.a, y.pieceA, y.handleA, y.b, y.pieceB, y.handleB, y.shift, y.number);
  }
};

/// A material that fills the plane z = 0 by repetition (thesis 4.3.2): the elements of one cell and two translations. A
/// finite patch is the same without translations (see cutPatch): its lattice is 0, and it has no images.
struct UnitCell {
  std::string name;
  std::vector<ElementShape> shapes;
  std::vector<InterlockingElement> elements;
  Eigen::Matrix2d lattice = Eigen::Matrix2d::Zero();  ///< translations in its columns [m]
  std::vector<Link> links;                            ///< that the material is meant to have at rest

  /// The length that gaps, steps and perturbations are measured by [m]: the least radius of all wires, see
  /// ElementShape::contactLengthOrThickness.
  double smallestRadius() const;
  bool isPeriodic() const { return !lattice.isZero(0); }
};

/// The same material with `first` x `second` cells as one, whose elements may then move differently.
UnitCell supercell(const UnitCell& cell, int first, int second);

/// The link with the same meaning whose element `a` is not after `b`, and if they are the same, whose shift is the
/// later one of (shift, -shift).
Link canonical(const Link& link);

/// Throws base::InputError (location empty) with one sentence: a faulty shape (see checkShape), no elements, a shape
/// that is not there, a position or rotation that is none, a lattice whose vectors are parallel, elements that overlap
/// at rest or are inside one another, closed pieces that are linked otherwise than declared. Only cells that pass may
/// be computed with.
void checkCell(const UnitCell& cell);
/// The part of it after which gaps and links can be measured: shapes, elements and lattice, each by itself.
void checkCellGeometry(const UnitCell& cell);

}  // namespace pliant::interlock
