#pragma once

#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Adds the scene's "parameters" to its model: any number of the scene that leaves the coordinates as they are.
/// `build` makes a model without them. Throws base::InputError with a JSON pointer as location.
void addSceneParameters(const Scene& scene, mechanics::Model& model, mechanics::Model (*build)(const Scene&));

}  // namespace pliant::scene
