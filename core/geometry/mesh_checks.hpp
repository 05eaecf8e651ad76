#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// The part of checkMesh without which a mesh cannot even be welded: there are triangles, points are finite, and the
/// indices of triangles and groups are in range. Throws base::InputError.
void checkPointsAndIndices(const SurfaceMesh& mesh);

}  // namespace pliant::geometry
