#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factories of the studies of cloth; their options stand in cloth_study_specs.cpp. They throw base::InputError for a
/// scene that is no cloth (cloth_builder.hpp), options that do not fit together, or a candidate that cannot be read.
std::unique_ptr<Study> makeClothMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);
std::unique_ptr<Study> makeClothDrapeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options);
std::unique_ptr<Study> makeProjectionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options);

}  // namespace pliant::scene
