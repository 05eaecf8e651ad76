#pragma once

#include <vector>

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// Whether a place is inside a polygon (2 x n, corners in order), by crossings of the ray along x.
bool isInPolygon(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& place);

/// [m²]; negative if the corners run clockwise.
double polygonArea(const Eigen::Matrix2Xd& polygon);

/// The flat piece inside the first polygon and outside the others (each 2 x n, corners in order) [m], in z = 0, meshed
/// irregularly with triangles counterclockwise from above: edges no longer than about `size` [m], angles above about
/// 20° wherever corners of the outline allow for it (Delaunay refinement, Shewchuk 2002). Throws base::InputError
/// (location empty) if there is no polygon, one has less than three corners, a corner that is not finite or no area, if
/// they cross themselves or each other, if a hole is not inside, or if there would be more than a million triangles.
SurfaceMesh meshOutline(const std::vector<Eigen::Matrix2Xd>& polygons, double size);

}  // namespace pliant::geometry
