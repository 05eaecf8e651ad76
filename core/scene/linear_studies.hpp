#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factories of the studies of the model linearised about its static equilibrium; their options stand in
/// study_specs.cpp.
std::unique_ptr<Study> makeLinearModesStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);
std::unique_ptr<Study> makeLinearResponseStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                               const Json& options);

}  // namespace pliant::scene
