#pragma once

#include <optional>
#include <vector>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// The Gauss linking number of two closed polygons (3 x n, corners in order) that have no point in common: the signed
/// crossings of the first over the second in a projection. It is counted as the second over the first as well, and in
/// another projection if rounding could decide; nothing if they differ, which means that the polygons meet.
std::optional<int> linkingNumber(const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second);

/// A closed polygon that goes round with a piece of a shape, in the shape's coordinates: of a wire one that stays
/// inside it, of a closed mesh a handle of handleCycles.
struct ElementLoop {
  int piece, handle;
  Eigen::Matrix3Xd corners;
  Ball ball;
};
std::vector<ElementLoop> loopsOfShape(const ElementShape& shape);

/// Finds which closed pieces of a cell are linked. A curve is replaced by a polygon that stays inside its wire, so as
/// long as elements do not overlap the numbers are exact; the handles of a closed mesh are those of handleCycles.
class LinkFinder {
 public:
  explicit LinkFinder(const CellContact& contact);

  /// All pairs whose number is not 0, canonical and sorted: each pair of an element and another one, or an image of
  /// itself, once. Nothing if elements overlap.
  std::optional<std::vector<Link>> linksAt(const CellState& state) const;

 private:
  const CellContact& contact_;
  std::vector<std::vector<ElementLoop>> loops_;  ///< by shape
};

}  // namespace pliant::interlock
