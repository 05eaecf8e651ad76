#pragma once

#include "core/cloth/cloth_simulation.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// What a study of the type cloth_motion simulates, for whoever steps it by hand.
struct ClothMotionSetup {
  std::shared_ptr<const cloth::ClothProblem> problem;
  cloth::SteppingOptions stepping;
  Provenance provenance;
};

/// Throws base::InputError for a scene that is no cloth, or if it has no such study.
ClothMotionSetup clothMotionSetup(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                  const std::string& study);

/// Factories of the studies of cloth; their options stand in cloth_study_specs.cpp. They throw base::InputError for a
/// scene that is no cloth (cloth_builder.hpp), options that do not fit together, or a candidate that cannot be read.
std::unique_ptr<Study> makeClothMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);
std::unique_ptr<Study> makeClothDrapeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options);
std::unique_ptr<Study> makeProjectionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options);

}  // namespace pliant::scene
