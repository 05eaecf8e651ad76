#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/surface_mesh.hpp"

namespace pliant::interlock {

/// Closed polygons (3 x n, corners in order) that count together; one that counts k times is there k times.
using Cycle = std::vector<Eigen::Matrix3Xd>;

/// One cycle for each handle of a solid body, along the edges of its surface: a basis of the loops that cannot be
/// contracted within the body (its first homology). None for a ball, one for a ring, three for three rings that are one
/// body. How often anything outside is linked with the body is told by its linking numbers with these. The cycle of a
/// ring runs along its wire, counterclockwise about the coordinate axis along which it encloses the largest area; those
/// of bodies with more handles depend on how their surface is cut into triangles.
///
/// A tree of edges and a tree of triangles that crosses none of its edges leave two edges a handle, which close the
/// loops of the surface (Eppstein 2003, "Dynamic generators of topologically embedded graphs"). A sum of these is
/// contracted within the body if it is linked with none of them, moved outwards a little: what remains modulo these
/// sums follows by reduction of the matrix of linking numbers to echelon form by integer row operations. The mesh must
/// have passed geometry::checkSolid.
std::vector<Cycle> handleCycles(const geometry::SurfaceMesh& mesh);

}  // namespace pliant::interlock
