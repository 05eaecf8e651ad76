#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factories of the studies whose options stand in study_specs.cpp. Both throw base::InputError if the number of
/// harmonics makes a system too large for this model.
std::unique_ptr<Study> makePeriodicMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                               const Json& options);
std::unique_ptr<Study> makeFrequencyResponseStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                  const Json& options);

}  // namespace pliant::scene
