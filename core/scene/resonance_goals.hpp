#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/parameter_spec.hpp"
#include "core/harmonic/resonance_objective.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// The keys of a design's objectives that place or avoid resonances, each with `weight`.
std::vector<base::ParameterSpec> resonanceGoalSpecs(const base::ParameterSpec& weight);

/// The objective of such an entry of a design study with `options`; null if `entry` is of another type. Throws
/// base::InputError at `place`, a JSON pointer.
std::shared_ptr<const harmonic::DesignObjective> resonanceGoal(const Json& entry, const std::string& place,
                                                               const mechanics::Model& model, const Json& options);

}  // namespace pliant::scene
