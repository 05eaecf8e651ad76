#include "core/interlock/detail_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/geometry/box_tree.hpp"
#include "core/geometry/simplex_distance.hpp"
#include "core/geometry/triangle_intersection.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using geometry::Corners;
using geometry::SimplexPair;

/// Chords of a whole wire: first so many, and where that is not enough to tell elements apart, more.
constexpr int fewChords = 64, manyChords = 1024;

/// A segment or triangle, in the shape's coordinates; a point is a segment of no length.
struct Simplex {
  Eigen::Matrix3d corners;
  int count;      ///< 2 or 3
  double radius;  ///< with the height of the chord [m]
  Vector3d middle;
  double reach;  ///< from the middle, with the radius [m]
};

void addSimplex(const Eigen::Matrix3d& corners, int count, double radius, std::vector<Simplex>& simplices) {
  const Vector3d middle = corners.leftCols(count).rowwise().mean();
  const double reach = (corners.leftCols(count).colwise() - middle).colwise().norm().maxCoeff();
  simplices.push_back({corners, count, radius, middle, reach + radius});
}

std::vector<Simplex> simplicesOf(const ElementShape& shape, int chords) {
  std::vector<Simplex> simplices;
  Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();
  for (const DilatedPiece& piece : shape.pieces) {
    if (const auto* curve = std::get_if<ClosedCurve>(&piece.core)) {
      const double step = 2 * std::numbers::pi / chords;
      const double height = step * step / 8 * curve->secondDerivativeBound();
      for (int i = 0; i < chords; ++i) {
        corners.col(0) = curve->placeAt(step * i);
        corners.col(1) = curve->placeAt(step * (i + 1));
        addSimplex(corners, 2, piece.radius + height, simplices);
      }
      continue;
    }
    const auto& set = std::get<SimplexSet>(piece.core);
    for (const int point : set.points) {
      corners.col(0) = corners.col(1) = set.corners.col(point);
      addSimplex(corners, 2, piece.radius, simplices);
    }
    for (const auto& [from, to] : set.segments) {
      corners.col(0) = set.corners.col(from);
      corners.col(1) = set.corners.col(to);
      addSimplex(corners, 2, piece.radius, simplices);
    }
    for (const auto& [a, b, c] : set.triangles) {
      corners << set.corners.col(a), set.corners.col(b), set.corners.col(c);
      addSimplex(corners, 3, piece.radius, simplices);
    }
  }
  return simplices;
}

double distanceOf(SimplexPair kind, const Corners& corners) {
  return std::sqrt(geometry::closestPoints(kind, corners).squaredDistance);
}

double segmentDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  Corners corners;
  corners << a, b, c, d;
  // Parallel segments are nearest at an end.
  const bool arePoints = a == b || c == d;
  double smallest = arePoints ? std::numeric_limits<double>::infinity() : distanceOf(SimplexPair::edgeEdge, corners);
  for (const auto& [point, from, to] :
       {std::array{a, c, d}, std::array{b, c, d}, std::array{c, a, b}, std::array{d, a, b}}) {
    const Vector3d along = to - from;
    const double squared = along.squaredNorm();
    const double share = squared > 0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0;
    smallest = std::min(smallest, (point - from - share * along).norm());
  }
  return smallest;
}

double segmentTriangleDistance(const Vector3d& p, const Vector3d& q, const Eigen::Matrix3d& triangle) {
  if (geometry::segmentMeetsTriangle(p, q, triangle.col(0), triangle.col(1), triangle.col(2))) return 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    smallest = std::min(smallest, segmentDistance(p, q, triangle.col(i), triangle.col((i + 1) % 3)));
  for (const Vector3d& point : {p, q}) {
    Corners corners;
    corners << point, triangle;
    smallest = std::min(smallest, distanceOf(SimplexPair::pointTriangle, corners));
  }
  return smallest;
}

/// Of the cores.
double distanceBetween(const Simplex& a, const Eigen::Matrix3d& cornersA, const Simplex& b,
                       const Eigen::Matrix3d& cornersB) {
  if (a.count == 2 && b.count == 2)
    return segmentDistance(cornersA.col(0), cornersA.col(1), cornersB.col(0), cornersB.col(1));
  if (a.count == 2) return segmentTriangleDistance(cornersA.col(0), cornersA.col(1), cornersB);
  if (b.count == 2) return segmentTriangleDistance(cornersB.col(0), cornersB.col(1), cornersA);
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    smallest = std::min(smallest, segmentTriangleDistance(cornersA.col(i), cornersA.col((i + 1) % 3), cornersB));
    smallest = std::min(smallest, segmentTriangleDistance(cornersB.col(i), cornersB.col((i + 1) % 3), cornersA));
  }
  return smallest;
}

struct PlacedElement {
  Vector3d position;
  Eigen::Matrix3d rotation;
};

double distanceOfElements(const std::vector<Simplex>& first, const PlacedElement& a, const std::vector<Simplex>& second,
                          const PlacedElement& b, double reach) {
  // Seen from the first.
  const Eigen::Matrix3d turn = a.rotation.transpose() * b.rotation;
  const Vector3d offset = a.rotation.transpose() * (b.position - a.position);
  double smallest = reach;
  for (const Simplex& other : second) {
    const Vector3d middle = turn * other.middle + offset;
    const Eigen::Matrix3d corners = (turn * other.corners).colwise() + offset;
    for (const Simplex& own : first) {
      const double touching = own.reach + other.reach + smallest;
      if ((own.middle - middle).squaredNorm() >= touching * touching) continue;
      smallest = std::min(smallest, distanceBetween(own, own.corners, other, corners) - own.radius - other.radius);
    }
  }
  return smallest;
}

}  // namespace

DetailCheck checkDetail(const UnitCell& cell, const std::vector<PatchElement>& elements, const CellState& state,
                        double reach) {
  std::vector<std::vector<Simplex>> few, many;
  std::vector<std::vector<ElementLoop>> loops;
  std::vector<double> reaches;
  for (const ElementShape& shape : cell.shapes) {
    few.push_back(simplicesOf(shape, fewChords));
    many.push_back(simplicesOf(shape, manyChords));
    loops.push_back(loopsOfShape(shape));
    double& farthest = reaches.emplace_back(0);
    for (const Simplex& simplex : few.back()) farthest = std::max(farthest, simplex.middle.norm() + simplex.reach);
  }
  const auto shapeOf = [&](int i) {
    const PatchElement& own = elements[static_cast<std::size_t>(i)];
    return static_cast<std::size_t>(cell.elements[static_cast<std::size_t>(own.element)].shape);
  };
  std::vector<geometry::BoxTree::Box> boxes;
  std::map<PatchElement, int> numbers;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Vector3d half = Vector3d::Constant(reaches[shapeOf(static_cast<int>(i))] + 0.5 * reach);
    const Vector3d place = state.positions.col(static_cast<Eigen::Index>(i));
    boxes.emplace_back(place - half, place + half);
    numbers.emplace(elements[i], static_cast<int>(i));
  }
  auto pairs = geometry::BoxTree(boxes).ownPairs([](int, int) { return true; });
  std::sort(pairs.begin(), pairs.end());

  // Loops of two elements that the material links: (a, loop, b, loop) -> number.
  std::map<std::array<int, 6>, int> expected;
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const Link& link : cell.links) {
      if (link.a != elements[i].element) continue;
      const auto& [first, second] = elements[i].shift;
      const auto other = numbers.find({link.b, {first + link.shift[0], second + link.shift[1]}});
      if (other == numbers.end()) continue;
      const int a = static_cast<int>(i), b = other->second;
      expected[a < b ? std::array{a, b, link.pieceA, link.handleA, link.pieceB, link.handleB}
                     : std::array{b, a, link.pieceB, link.handleB, link.pieceA, link.handleA}] = link.number;
    }
  DetailCheck check;
  check.pairs = static_cast<long>(pairs.size());
  check.links = static_cast<long>(expected.size());
  check.smallestDistance = reach;
  struct Found {
    double distance;
    std::vector<std::pair<std::array<int, 6>, int>> links;  ///< not 0; a number that cannot be told is a large one
  };
  std::vector<Found> found(pairs.size());
  math::parallelFor(static_cast<int>(pairs.size()), [&](int k) {
    const auto& [i, j] = pairs[static_cast<std::size_t>(k)];
    const auto placed = [&](int element) {
      return PlacedElement{state.positions.col(element), state.rotations[static_cast<std::size_t>(element)]};
    };
    const PlacedElement a = placed(i), b = placed(j);
    Found& own = found[static_cast<std::size_t>(k)];
    own.distance = distanceOfElements(few[shapeOf(i)], a, few[shapeOf(j)], b, reach);
    if (own.distance < 0.1 * reach) own.distance = distanceOfElements(many[shapeOf(i)], a, many[shapeOf(j)], b, reach);
    std::map<std::array<int, 6>, int> sums;  // a handle may have several polygons
    for (const ElementLoop& first : loops[shapeOf(i)])
      for (const ElementLoop& second : loops[shapeOf(j)]) {
        const Matrix3Xd polygonA = (a.rotation * first.corners).colwise() + (a.position - b.position);
        const auto number = linkingNumber(polygonA, b.rotation * second.corners);
        constexpr int unknown = 1000;
        if (number.value_or(unknown) != 0)
          sums[{i, j, first.piece, first.handle, second.piece, second.handle}] += number.value_or(unknown);
      }
    for (const auto& [place, number] : sums)
      if (number != 0) own.links.push_back({place, number});
  });
  long held = 0;
  for (const Found& own : found) {
    check.smallestDistance = std::min(check.smallestDistance, own.distance);
    for (const auto& [place, number] : own.links) {
      const auto wanted = expected.find(place);
      if (wanted == expected.end())
        ++check.newLinks;
      else if (wanted->second == number)
        ++held;
    }
  }
  check.lostLinks = check.links - held;
  return check;
}

}  // namespace pliant::interlock
