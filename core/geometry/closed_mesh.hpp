#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// Throws base::InputError (location empty) with a sentence unless checkMesh is content and the mesh is a closed
/// manifold: each edge has two triangles, which run along it in opposite directions, and the triangles of each point
/// form one fan.
void checkClosed(const SurfaceMesh& mesh);

/// What a closed mesh encloses [m³]; negative if its normals point inwards.
double enclosedVolume(const SurfaceMesh& mesh);

/// The centroid of what a closed mesh encloses.
Eigen::Vector3d enclosedCentroid(const SurfaceMesh& mesh);

}  // namespace pliant::geometry
