#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factories of the studies in the time domain; their options stand in study_specs.cpp. Both throw base::InputError for
/// options that do not fit together.
std::unique_ptr<Study> makeTimeIntegrationStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                const Json& options);
std::unique_ptr<Study> makeComparisonStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options);

}  // namespace pliant::scene
