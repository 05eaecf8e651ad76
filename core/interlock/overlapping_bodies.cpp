#include "core/interlock/overlapping_bodies.hpp"

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/triangle_intersection.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// The simplices of an element in space.
geometry::SurfaceMesh placedMesh(const SimplexSet& set, const Eigen::Matrix3d& rotation, const Vector3d& offset) {
  return {(rotation * set.corners).colwise() + offset, set.triangles, {}, {}};
}

Vector3d anyPlaceOf(const DilatedPiece& piece) {
  if (const auto* curve = std::get_if<ClosedCurve>(&piece.core)) return curve->placeAt(0);
  const SimplexSet& set = std::get<SimplexSet>(piece.core);
  const int corner = !set.triangles.empty()  ? set.triangles[0][0]
                     : !set.segments.empty() ? set.segments[0][0]
                                             : set.points[0];
  return set.corners.col(corner);
}

/// Whether an edge of one crosses a triangle of the other.
bool surfacesCross(const geometry::SurfaceMesh& a, const SimplexSet& set, const geometry::SurfaceMesh& b) {
  const int first = static_cast<int>(a.points.cols());
  Matrix3Xd points(3, first + b.points.cols());
  points << a.points, b.points;
  std::vector<std::array<int, 3>> triangles = a.triangles;
  std::vector<std::array<int, 2>> segments;
  for (const auto& [i, j, k] : set.triangles) triangles.push_back({first + i, first + j, first + k});
  for (const auto& [i, j] : set.segments) segments.push_back({first + i, first + j});
  for (const auto& [edge, triangle] : geometry::findIntersections(points, triangles, segments))
    if ((edge[0] < first) != (triangle[0] < first)) return true;
  return false;
}

}  // namespace

std::optional<CellContact::ImagePair> overlappingBodies(const CellContact& contact, const CellState& state) {
  const UnitCell& cell = contact.cell();
  const auto piecesOf = [&](int element) -> const std::vector<DilatedPiece>& {
    return cell.shapes[cell.elements[element].shape].pieces;
  };
  for (const auto& pair : contact.nearElements(state, 0)) {
    const Vector3d offset = contact.offsetOf(state, pair.a, pair.b, pair.shift);
    // Seen from the origin of `other`, whose pieces are in or through the meshes of `own`.
    const auto holds = [&](int own, int other, const Vector3d& between) {
      for (const DilatedPiece& piece : piecesOf(own)) {
        if (!isClosedMesh(piece)) continue;
        const auto mesh = placedMesh(std::get<SimplexSet>(piece.core), state.rotations[own], between);
        for (const DilatedPiece& otherPiece : piecesOf(other)) {
          if (geometry::windingNumber(mesh, state.rotations[other] * anyPlaceOf(otherPiece)) != 0) return true;
          if (const auto* set = std::get_if<SimplexSet>(&otherPiece.core))
            if (surfacesCross(mesh, *set, placedMesh(*set, state.rotations[other], Vector3d::Zero()))) return true;
        }
      }
      return false;
    };
    if (holds(pair.a, pair.b, offset) || holds(pair.b, pair.a, -offset)) return pair;
  }
  return std::nullopt;
}

}  // namespace pliant::interlock
