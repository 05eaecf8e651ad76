#pragma once

#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Meshes, energies, masses, boundary conditions, drives and loads of a scene. Throws base::InputError.
std::shared_ptr<const mechanics::Model> buildModel(const Scene& scene);

/// The triangles of all the model's parts, with every node at `positions` (of all coordinates) [m].
geometry::SurfaceMesh surfaceAt(const mechanics::Model& model, const mechanics::Vector& positions);

}  // namespace pliant::scene
