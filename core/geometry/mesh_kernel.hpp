#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// From where all of a closed surface is seen: a point, and how far it is behind the plane of each triangle at least
/// [m].
struct KernelPoint {
  Eigen::Vector3d point;
  double depth = 0;
};

/// How far a point is behind the plane of each triangle at least [m]; all is seen from it if that is above 0.
double kernelDepth(const SurfaceMesh& mesh, const Eigen::Vector3d& point);

/// The point of largest depth, which is unique or one of many: where it is not above 0 there is no point from where all
/// is seen. A linear program in four unknowns, by an interior-point method, to 10⁻⁹ of the surface's size. `mesh` is
/// closed, with triangles counterclockwise from outside, all with an area.
KernelPoint deepestKernelPoint(const SurfaceMesh& mesh);

}  // namespace pliant::geometry
