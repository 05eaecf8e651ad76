#include "core/interlock/fabric_patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "core/base/error.hpp"
#include "core/geometry/outline_mesh.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;

constexpr double mostExportedElements = 1e6;

void refuseSize(double count) {
  if (!(count <= mostExportedElements)) throw base::InputError("", "the patch would have more than a million elements");
}

}  // namespace

FabricPatch linkedPatch(const UnitCell& cell, std::vector<PatchElement> elements) {
  std::sort(elements.begin(), elements.end());
  std::map<PatchElement, int> index;
  for (const PatchElement& element : elements) index.emplace(element, static_cast<int>(index.size()));
  std::vector<int> parent(elements.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const Link& link : cell.links) {
      if (link.a != elements[i].element) continue;
      const auto& [first, second] = elements[i].shift;
      const auto other = index.find({link.b, {first + link.shift[0], second + link.shift[1]}});
      if (other != index.end()) parent[root(other->second)] = root(static_cast<int>(i));
    }
  std::vector<int> sizes(elements.size(), 0);
  for (std::size_t i = 0; i < elements.size(); ++i) ++sizes[root(static_cast<int>(i))];
  const int largest = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  FabricPatch patch;
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (root(static_cast<int>(i)) == largest) patch.elements.push_back(elements[i]);
  patch.leftOut = static_cast<int>(elements.size() - patch.elements.size());
  return patch;
}

FabricPatch patchOfCells(const UnitCell& cell, int first, int second) {
  if (first < 1 || second < 1)
    throw base::InputError("", "a patch needs at least one cell in each direction, but is " + std::to_string(first) +
                                   " x " + std::to_string(second));
  refuseSize(static_cast<double>(first) * second * static_cast<double>(cell.elements.size()));
  std::vector<PatchElement> elements;
  for (int i = 0; i < first; ++i)
    for (int j = 0; j < second; ++j)
      for (std::size_t k = 0; k < cell.elements.size(); ++k) elements.push_back({static_cast<int>(k), {i, j}});
  return linkedPatch(cell, std::move(elements));
}

FabricPatch patchInside(const UnitCell& cell, const CellState& state, const Matrix2Xd& polygon) {
  if (polygon.cols() < 3) throw base::InputError("", "an outline needs at least three corners");
  if (!polygon.allFinite()) throw base::InputError("", "a corner of the outline is not finite");
  const double area = geometry::polygonArea(polygon);
  const Vector2d low = polygon.rowwise().minCoeff(), high = polygon.rowwise().maxCoeff(), middle = 0.5 * (low + high);
  if (!(std::abs(area) > 1e-9 * (high - low).squaredNorm())) throw base::InputError("", "the outline encloses no area");
  const Eigen::Matrix2d lattice = stretchOf(state.strain) * cell.lattice, inverse = lattice.inverse();
  refuseSize((high - low).prod() / std::abs(lattice.determinant()) * static_cast<double>(cell.elements.size()));
  std::vector<PatchElement> elements;
  for (std::size_t k = 0; k < cell.elements.size(); ++k) {
    const Vector2d own = state.positions.col(static_cast<Eigen::Index>(k)).head<2>();
    // The box as seen by the lattice.
    const Vector2d centre = inverse * -own, extent = inverse.cwiseAbs() * (0.5 * (high - low));
    for (int i = static_cast<int>(std::ceil(centre[0] - extent[0])); i <= centre[0] + extent[0]; ++i)
      for (int j = static_cast<int>(std::ceil(centre[1] - extent[1])); j <= centre[1] + extent[1]; ++j)
        if (geometry::isInPolygon(polygon, middle + own + lattice * Vector2d(i, j)))
          elements.push_back({static_cast<int>(k), {i, j}});
  }
  if (elements.empty()) throw base::InputError("", "no element is inside of the outline");
  return linkedPatch(cell, std::move(elements));
}

Matrix2Xd rectangleOutline(double width, double height) {
  return 0.5 * (Matrix2Xd(2, 4) << -width, width, width, -width, -height, -height, height, height).finished();
}

Matrix2Xd circleOutline(double diameter) {
  constexpr int count = 256;
  Matrix2Xd corners(2, count);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    corners.col(i) = 0.5 * diameter * Vector2d(std::cos(angle), std::sin(angle));
  }
  return corners;
}

Eigen::Vector3d placeOf(const UnitCell& cell, const CellState& state, const PatchElement& element) {
  Eigen::Vector3d place = state.positions.col(element.element);
  place.head<2>() += stretchOf(state.strain) * (cell.lattice * Vector2d(element.shift[0], element.shift[1]));
  return place;
}

double clearance(const UnitCell& cell, const CellState& state) {
  const CellContact contact(cell);
  // Doubled until something is that near: an element and its image always are in the end.
  for (double reach = cell.smallestRadius();; reach *= 2)
    if (const double gap = contact.smallestGap(state, reach); gap < reach) return gap;
}

}  // namespace pliant::interlock
