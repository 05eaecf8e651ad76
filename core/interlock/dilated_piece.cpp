#include "core/interlock/dilated_piece.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"

namespace pliant::interlock {

namespace {

[[noreturn]] void failPiece(const ElementShape& shape, std::size_t piece, const std::string& problem) {
  throw base::InputError("", "piece " + std::to_string(piece) + " of element \"" + shape.name + "\" " + problem);
}

void checkCurve(const ElementShape& shape, std::size_t piece, const ClosedCurve& curve) {
  bool finite = curve.centre().allFinite();
  double size = 0;
  for (const auto& harmonic : curve.harmonics()) {
    finite = finite && harmonic.cosine.allFinite() && harmonic.sine.allFinite();
    size += harmonic.cosine.norm() + harmonic.sine.norm();
  }
  if (!finite) failPiece(shape, piece, "has a coordinate that is not finite");
  if (!(size > 0)) failPiece(shape, piece, "is a curve of no length");
  constexpr int samples = 720;
  for (int i = 0; i < samples; ++i)
    if (curve.at(2 * std::numbers::pi * i / samples).tangent.norm() < 1e-9 * size)
      failPiece(shape, piece, "is a curve that stops and turns back, but must be smooth");
}

void checkSimplices(const ElementShape& shape, std::size_t piece, const SimplexSet& set) {
  if (!set.corners.allFinite()) failPiece(shape, piece, "has a coordinate that is not finite");
  if (set.points.empty() && set.segments.empty() && set.triangles.empty())
    failPiece(shape, piece, "has neither points, segments nor triangles");
  std::map<int, int> ends;
  std::map<std::array<int, 2>, int> sides;
  const auto check = [&](auto&& nodes) {
    for (const int node : nodes)
      if (node < 0 || node >= set.corners.cols())
        failPiece(
            shape, piece,
            "names corner " + std::to_string(node) + ", but has " + std::to_string(set.corners.cols()) + " corners");
  };
  check(set.points);
  for (const auto& segment : set.segments) {
    check(segment);
    if (!((set.corners.col(segment[0]) - set.corners.col(segment[1])).norm() > 0))
      failPiece(shape, piece, "has a segment of no length");
    for (const int node : segment) ++ends[node];
  }
  for (const auto& [a, b, c] : set.triangles) {
    check(std::array{a, b, c});
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      ++sides[{std::min(from, to), std::max(from, to)}];
    const Eigen::Vector3d first = set.corners.col(b) - set.corners.col(a),
                          second = set.corners.col(c) - set.corners.col(a);
    const double longest = std::max({first.squaredNorm(), second.squaredNorm(), (first - second).squaredNorm()});
    if (!(first.cross(second).norm() > 2 * geometry::smallestRelativeArea * longest))
      failPiece(shape, piece, "has a triangle of no area");
  }
  if (!set.closed) return;
  for (const auto& [node, count] : ends)
    if (count != 2) failPiece(shape, piece, "must be closed, but its chain is open at corner " + std::to_string(node));
  for (const auto& [side, count] : sides)
    if (count != 2)
      failPiece(shape, piece,
                "must be closed, but its surface is open between corners " + std::to_string(side[0]) + " and " +
                    std::to_string(side[1]));
}

geometry::SurfaceMesh meshOf(const SimplexSet& set) { return {set.corners, set.triangles, {}, {}}; }

}  // namespace

bool isClosedMesh(const DilatedPiece& piece) {
  const auto* set = std::get_if<SimplexSet>(&piece.core);
  return set && set->closed && !set->triangles.empty() && set->segments.empty() && set->points.empty();
}

double halfThickness(const DilatedPiece& piece) {
  if (!isClosedMesh(piece)) return piece.radius;
  const geometry::SurfaceMesh mesh = meshOf(std::get<SimplexSet>(piece.core));
  return piece.radius + 2 * std::abs(geometry::enclosedVolume(mesh)) / geometry::surfaceArea(mesh);
}

double ElementShape::contactLengthOrThickness() const {
  if (contactLength > 0) return contactLength;
  double least = std::numeric_limits<double>::infinity();
  for (const DilatedPiece& piece : pieces) least = std::min(least, halfThickness(piece));
  return least;
}

DilatedPiece wire(const ClosedCurve& curve, double radius) { return {curve, radius}; }

DilatedPiece capsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  SimplexSet set;
  set.corners.resize(3, 2);
  set.corners << from, to;
  set.segments = {{0, 1}};
  return {set, radius};
}

DilatedPiece roundedPolygon(const Eigen::Matrix3Xd& corners, double radius) {
  SimplexSet set;
  set.corners = corners;
  for (int i = 1; i + 1 < corners.cols(); ++i) set.triangles.push_back({0, i, i + 1});
  return {set, radius};
}

DilatedPiece closedChain(const Eigen::Matrix3Xd& points, double radius) {
  SimplexSet set;
  set.corners = points;
  const int count = static_cast<int>(points.cols());
  for (int i = 0; i < count; ++i) set.segments.push_back({i, (i + 1) % count});
  set.closed = true;
  return {set, radius};
}

DilatedPiece dilatedMesh(const geometry::SurfaceMesh& mesh, double radius) {
  SimplexSet set;
  set.corners = mesh.points;
  set.triangles = mesh.triangles;
  set.closed = true;
  return {set, radius};
}

void checkShape(const ElementShape& shape) {
  if (shape.pieces.empty()) throw base::InputError("", "element \"" + shape.name + "\" has no pieces");
  for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
    const DilatedPiece& piece = shape.pieces[i];
    const bool isBody = isClosedMesh(piece);
    if (!(isBody ? piece.radius >= 0 : piece.radius > 0) || !std::isfinite(piece.radius))
      failPiece(shape, i,
                "has the radius " + std::to_string(piece.radius) + " m, but it must " +
                    (isBody ? "not be negative" : "be above 0"));
    if (const auto* curve = std::get_if<ClosedCurve>(&piece.core))
      checkCurve(shape, i, *curve);
    else
      checkSimplices(shape, i, std::get<SimplexSet>(piece.core));
    if (isBody) {
      try {
        geometry::checkOneSolid(meshOf(std::get<SimplexSet>(piece.core)));
      } catch (const base::InputError& error) {
        failPiece(shape, i, "is not the surface of a body: " + error.problem());
      }
    }
  }
  if (!(shape.contactLength >= 0) || !std::isfinite(shape.contactLength))
    throw base::InputError("", "the contact length of element \"" + shape.name + "\" must not be negative");
}

}  // namespace pliant::interlock
