#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factory of the study "design_space", whose options stand in design_space_specs.cpp. Throws base::InputError for a
/// parameter that the scene does not have, or too many harmonics.
std::unique_ptr<Study> makeDesignSpaceStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);

}  // namespace pliant::scene
