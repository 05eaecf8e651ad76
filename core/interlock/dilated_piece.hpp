#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "core/geometry/surface_mesh.hpp"
#include "core/interlock/closed_curve.hpp"

namespace pliant::interlock {

/// Points, segments and triangles that share corners (3 x n) [m].
struct SimplexSet {
  Eigen::Matrix3Xd corners;
  std::vector<int> points;
  std::vector<std::array<int, 2>> segments;
  std::vector<std::array<int, 3>> triangles;
  /// Segments must form loops, and triangles a surface without rim: checked in checkShape.
  bool closed = false;
};

/// All places nearer than `radius` to a curve or to simplices: a wire, a rounded rod or plate, or a body whose surface
/// is a triangle mesh, with rounded edges.
struct DilatedPiece {
  std::variant<ClosedCurve, SimplexSet> core;
  double radius = 0;  ///< [m], above 0; of a closed mesh it may be 0
};

/// Whether the piece is the surface of a body: closed, and of triangles alone.
bool isClosedMesh(const DilatedPiece& piece);
/// Half of how thick a piece is [m]: its radius; of a closed mesh that plus the radius of a wire of the same volume and
/// surface, 2V/A.
double halfThickness(const DilatedPiece& piece);

DilatedPiece wire(const ClosedCurve& curve, double radius);
/// A rod with round ends from `from` to `to` [m].
DilatedPiece capsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// A plate: the convex polygon with these corners (3 x n, in order) [m], rounded.
DilatedPiece roundedPolygon(const Eigen::Matrix3Xd& corners, double radius);
/// A closed chain of segments through the points (3 x n) [m], such as a wire that bends sharply.
DilatedPiece closedChain(const Eigen::Matrix3Xd& points, double radius);
/// The surface of a body; it must be closed.
DilatedPiece dilatedMesh(const geometry::SurfaceMesh& mesh, double radius);

/// The rigid body that a material repeats: the union of its pieces, which may overlap each other. Coordinates are
/// relative to the point about which it turns.
struct ElementShape {
  std::string name;
  std::vector<DilatedPiece> pieces;
  /// The farthest from each other at which surfaces push, and what gaps, steps and perturbations are measured by [m];
  /// 0: half the thickness of the thinnest piece.
  double contactLength = 0;

  double contactLengthOrThickness() const;
};

/// Throws base::InputError (location empty) with a sentence that names shape and piece: no pieces, a radius not above
/// 0 (below it, of a closed mesh), a coordinate not finite, a curve, segment or triangle of no size, corners out of
/// range, or an open piece that is declared closed. A closed mesh must be the surface of one body, see
/// geometry::checkSolid.
void checkShape(const ElementShape& shape);

}  // namespace pliant::interlock
