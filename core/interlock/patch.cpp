#include "core/interlock/patch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>

#include "core/base/error.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int mostElements = 4000;

[[noreturn]] void failPatch(const std::string& problem) { throw base::InputError("", problem); }

bool isInsideOutline(const PatchOutline& outline, const Vector2d& place, double tolerance) {
  const Vector2d from = place - outline.centre;
  if (outline.kind == PatchOutline::Kind::circle) return from.norm() <= outline.radius + tolerance;
  return (2 * from.cwiseAbs() - outline.size).maxCoeff() <= 2 * tolerance;
}

/// Volume and first moment.
struct Moments {
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  void add(double part, const Vector3d& centre) {
    volume += part;
    first += part * centre;
  }
};

void addTubeMoments(const ClosedCurve& curve, double radius, Moments& moments) {
  // The trapezoidal rule converges exponentially on closed smooth curves.
  constexpr int count = 720;
  for (int i = 0; i < count; ++i) {
    const auto point = curve.at(2 * std::numbers::pi * i / count);
    moments.add(std::numbers::pi * radius * radius * point.tangent.norm() * 2 * std::numbers::pi / count, point.place);
  }
}

void addSimplexMoments(const SimplexSet& set, double radius, Moments& moments) {
  const auto corner = [&](int i) -> Vector3d { return set.corners.col(i); };
  const double ball = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
  for (const int i : set.points) moments.add(ball, corner(i));
  std::map<int, int> ends;  // segments that meet in a corner
  for (const auto& [from, to] : set.segments) {
    moments.add(
        std::numbers::pi * radius * radius * (corner(to) - corner(from)).norm(), 0.5 * (corner(from) + corner(to)));
    ++ends[from], ++ends[to];
  }
  for (const auto& [i, count] : ends)
    if (count == 1) moments.add(0.5 * ball, corner(i));
  std::map<std::array<int, 2>, int> sides;
  for (const auto& [a, b, c] : set.triangles) {
    const Vector3d normal = (corner(b) - corner(a)).cross(corner(c) - corner(a)),
                   middle = (corner(a) + corner(b) + corner(c)) / 3;
    if (set.closed) {  // the tetrahedron to the origin, and the outer half of the layer
      moments.add(corner(a).dot(normal) / 6, 0.75 * middle);
      moments.add(0.5 * normal.norm() * radius, middle);
    } else {
      moments.add(normal.norm() * radius, middle);
    }
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      ++sides[{std::min(from, to), std::max(from, to)}];
  }
  double rim = 0;
  Vector3d rimMoment = Vector3d::Zero();
  for (const auto& [side, count] : sides) {
    if (count != 1) continue;
    const double length = (corner(side[1]) - corner(side[0])).norm();
    const Vector3d middle = 0.5 * (corner(side[0]) + corner(side[1]));
    moments.add(0.5 * std::numbers::pi * radius * radius * length, middle);
    rim += length;
    rimMoment += length * middle;
  }
  if (rim > 0) moments.add(ball, rimMoment / rim);
}

}  // namespace

UnitCell cutPatch(const UnitCell& cell, const PatchOutline& outline) {
  const double scale = std::sqrt(std::abs(cell.lattice.determinant())), tolerance = 1e-9 * scale;
  const Vector2d half = outline.kind == PatchOutline::Kind::circle ? Vector2d::Constant(outline.radius).eval()
                                                                   : Vector2d(0.5 * outline.size);
  if (!(half.minCoeff() > 0) || !half.allFinite()) failPatch("the size of the patch must be above 0");
  if (half.prod() * 4 > 4 * mostElements * scale * scale)
    failPatch("the patch would have more than " + std::to_string(mostElements) + " elements");
  const Eigen::Matrix2d inverse = cell.lattice.inverse();
  UnitCell patch;
  patch.name = cell.name;
  patch.shapes = cell.shapes;
  std::map<std::array<int, 3>, int> indices;  // by cell and element
  Vector2d farthest = Vector2d::Zero();
  for (const InterlockingElement& element : cell.elements)
    farthest = farthest.cwiseMax(element.position.head<2>().cwiseAbs());
  const Vector2d middle = inverse * outline.centre, extent = inverse.cwiseAbs() * (half + farthest);
  for (int i = static_cast<int>(std::floor(middle[0] - extent[0])); i <= middle[0] + extent[0] + 1; ++i)
    for (int j = static_cast<int>(std::floor(middle[1] - extent[1])); j <= middle[1] + extent[1] + 1; ++j)
      for (std::size_t k = 0; k < cell.elements.size(); ++k) {
        InterlockingElement element = cell.elements[k];
        element.position.head<2>() += cell.lattice * Vector2d(i, j);
        if (!isInsideOutline(outline, element.position.head<2>(), tolerance)) continue;
        indices[{i, j, static_cast<int>(k)}] = static_cast<int>(patch.elements.size());
        patch.elements.push_back(element);
      }
  if (patch.elements.size() < 2)
    failPatch("the patch has " + std::to_string(patch.elements.size()) + " elements, but needs two at least");
  if (patch.elements.size() > mostElements)
    failPatch("the patch would have more than " + std::to_string(mostElements) + " elements");
  for (const auto& [place, index] : indices)
    for (const Link& link : cell.links) {
      if (link.a != place[2] || link.number == 0) continue;
      const auto other = indices.find({place[0] + link.shift[0], place[1] + link.shift[1], link.b});
      if (other != indices.end())
        patch.links.push_back(canonical(
            {index, link.pieceA, other->second, link.pieceB, {0, 0}, link.number, link.handleA, link.handleB}));
    }
  std::sort(patch.links.begin(), patch.links.end());
  Vector2d mean = Vector2d::Zero();
  for (const InterlockingElement& element : patch.elements)
    mean += element.position.head<2>() / static_cast<double>(patch.elements.size());
  for (InterlockingElement& element : patch.elements) element.position.head<2>() -= mean;
  if (linkDistances(patch).minCoeff() < 0)
    failPatch("some of the " + std::to_string(patch.elements.size()) +
              " elements of the patch are not linked with the others; choose another size or centre");
  return patch;
}

Eigen::MatrixXi linkDistances(const UnitCell& patch) {
  const int count = static_cast<int>(patch.elements.size());
  std::vector<std::vector<int>> neighbours(count);
  for (const Link& link : patch.links) {
    neighbours[link.a].push_back(link.b);
    neighbours[link.b].push_back(link.a);
  }
  Eigen::MatrixXi distances = Eigen::MatrixXi::Constant(count, count, -1);
  for (int from = 0; from < count; ++from) {
    std::deque<int> queue{from};
    distances(from, from) = 0;
    while (!queue.empty()) {
      const int at = queue.front();
      queue.pop_front();
      for (const int next : neighbours[at]) {
        if (distances(from, next) >= 0) continue;
        distances(from, next) = distances(from, at) + 1;
        queue.push_back(next);
      }
    }
  }
  return distances;
}

BodyMass bodyMass(const ElementShape& shape) {
  Moments moments;
  for (const auto& [core, radius] : shape.pieces) {
    if (const auto* curve = std::get_if<ClosedCurve>(&core))
      addTubeMoments(*curve, radius, moments);
    else
      addSimplexMoments(std::get<SimplexSet>(core), radius, moments);
  }
  return {moments.volume, moments.first / moments.volume};
}

}  // namespace pliant::interlock
