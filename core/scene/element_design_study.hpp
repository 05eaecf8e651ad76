#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factory of the study "element_design", whose options stand in element_design_specs.cpp. Throws base::InputError for
/// a number that the material does not have, bounds that do not hold it, or goals that cannot be read.
std::unique_ptr<Study> makeElementDesignStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                              const Json& options);

}  // namespace pliant::scene
