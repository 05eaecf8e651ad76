#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// Throws base::InputError (location empty) with a sentence unless checkMesh is content and the mesh is a closed
/// manifold: each edge has two triangles, which run along it in opposite directions, and the triangles of each point
/// form one fan.
void checkClosed(const SurfaceMesh& mesh);

/// The same, and that it is what a printer can make: triangles face outwards (counterclockwise seen from there), and
/// none meets another that it has no corner in common with.
void checkSolid(const SurfaceMesh& mesh);

/// The same, and that it is one connected surface.
void checkOneSolid(const SurfaceMesh& mesh);

/// What a closed mesh encloses [m³]; negative if its normals point inwards.
double enclosedVolume(const SurfaceMesh& mesh);
/// [m²]
double surfaceArea(const SurfaceMesh& mesh);

/// How often the closed mesh encloses a place that is not on it: 1 inside, 0 outside, if its normals point outwards.
int windingNumber(const SurfaceMesh& mesh, const Eigen::Vector3d& place);

/// The centroid of what a closed mesh encloses.
Eigen::Vector3d enclosedCentroid(const SurfaceMesh& mesh);

}  // namespace pliant::geometry
