#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// "bending_test", "curvature_limits", "bending_size", "bending_boundary", "gravity_bending".
std::unique_ptr<Study> makeBendingStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                        const Json& options);

}  // namespace pliant::scene
