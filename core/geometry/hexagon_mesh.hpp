#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// `rings` rings of triangles around (0, 0) in the plane z = 0, counterclockwise, 1 + 3 rings (rings + 1) points: a
/// regular hexagon of equilateral triangles with corners on the x axis, or a disk with the points of each ring on a
/// circle. Throws base::InputError unless the radius is above 0 and there are 1 to 800 rings.
SurfaceMesh makeHexagon(double radius, int rings);
SurfaceMesh makeDisk(double radius, int rings);

}  // namespace pliant::geometry
