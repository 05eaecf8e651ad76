#pragma once

#include "core/harmonic/design_constraint.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// What the "constraints" of a design study, which stand at `place`, mean for the scene's model. Throws
/// base::InputError.
std::vector<harmonic::DesignConstraint> readDesignConstraints(const Scene& scene, const mechanics::Model& model,
                                                              const Json& constraints, const std::string& place);

}  // namespace pliant::scene
