#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Throws base::InputError at the key of the study if this number of harmonics makes a system too large for the model;
/// of two driving frequencies, with `samplesOfEach` samples of a period of each, also at "samples".
void requireModestSize(const Scene& scene, const std::shared_ptr<const mechanics::Model>& model,
                       const std::string& study, const std::string& key, int harmonics, int samplesOfEach = 0);

/// Factories of the studies whose options stand in study_specs.cpp. All throw base::InputError if the number of
/// harmonics makes a system too large for this model.
std::unique_ptr<Study> makePeriodicMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                               const Json& options);
std::unique_ptr<Study> makeFrequencyResponseStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                  const Json& options);
std::unique_ptr<Study> makeBackboneStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                         const Json& options);

}  // namespace pliant::scene
