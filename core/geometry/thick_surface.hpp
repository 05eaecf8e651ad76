#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// The solid that a surface becomes when its triangles have a thickness [m], one for each: both sides lie half of it
/// from `middle`, along the normals at its points, and walls stand at its boundaries. At a fold the points go so much
/// farther that both neighbours keep their thickness (a mitre; up to twice as far). A point has the mean thickness of
/// its triangles, weighted by their angles there. Triangles are turned to agree with the first of each connected part;
/// a part without a boundary becomes a hollow body. Points of no triangle are left out. Throws base::InputError
/// (location empty): a surface that checkMesh refuses, that is one-sided or touches itself at a point, a thickness that
/// is not above 0.
SurfaceMesh thickenSurface(const SurfaceMesh& middle, const std::vector<double>& thickness);

/// The points that triangles have, in their order, and the triangles of these; no groups and textures.
SurfaceMesh withoutLoosePoints(const SurfaceMesh& mesh);

}  // namespace pliant::geometry
