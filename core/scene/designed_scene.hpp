#pragma once

#include "core/scene/design_result.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// `scene`, as JSON, with other values of some parameters of `model`, by index in `Model::parameters`. Throws
/// base::InputError if the scene has changed so that a parameter has no place in it.
Json sceneWithValues(const Scene& scene, const mechanics::Model& model, const std::vector<int>& parameters,
                     const mechanics::Vector& values);

/// `scene`, as JSON, with the values that a design of it gives to its parameters. Throws base::InputError if the scene
/// has changed so that a parameter has no place in it.
Json designedScene(const Scene& scene, const DesignResult& result, const harmonic::DesignIterate& design);

}  // namespace pliant::scene
