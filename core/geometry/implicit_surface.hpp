#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// A place as a body's surface sees it.
struct SurfacePlace {
  double distance;          ///< to the surface, negative inside [m]
  Eigen::Vector3d nearest;  ///< where it goes to reach the surface [m]
};

/// A body by its distance: |distance| is never more than the true one, and has its sign. Where two parts of a body run
/// into each other `nearest` may lie inside of one of them.
using BodyDistance = std::function<SurfacePlace(const Eigen::Vector3d& place)>;

struct SurfaceFit {
  double deviation = 0;  ///< largest distance of the middles of edges and triangles from the surface [m]
  /// The same where the mesh goes across a narrow opening between two parts of the body; 0 if it does so nowhere [m].
  double filled = 0;
};

struct BodyMesh {
  SurfaceMesh mesh;  ///< closed, normals outwards
  SurfaceFit fit;
  int bodies = 0;  ///< connected parts
};

/// The surface of a body as a closed manifold mesh: the surface is cut by the tetrahedra of a grid of cubes
/// (Bloomenthal 1994, "An implicit surface polygonizer"), which gives a manifold whatever the body is, short edges are
/// collapsed, and edges are halved until the middles of edges and triangles are within `tolerance` of the surface.
/// `cell` should be at most half of the smallest radius: openings narrower than a cube, such as between two rods that
/// cross, are filled. Lengths in [m]. Throws base::InputError (location empty) if the grid would have more than 20
/// million cubes at the surface, or if there is no body in the box.
BodyMesh meshBody(const BodyDistance& body, const Eigen::AlignedBox3d& box, double cell, double tolerance);

}  // namespace pliant::geometry
