#pragma once

#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Meshes, energies, masses, boundary conditions, drives and loads of a scene. Throws base::InputError.
std::shared_ptr<const mechanics::Model> buildModel(const Scene& scene);

}  // namespace pliant::scene
