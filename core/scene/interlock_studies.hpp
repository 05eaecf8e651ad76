#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

std::unique_ptr<Study> makeCellTestStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                         const Json& options);
std::unique_ptr<Study> makeFreeTravelStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options);
std::unique_ptr<Study> makeStretchGridStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);
std::unique_ptr<Study> makeStretchBoundaryStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                const Json& options);

}  // namespace pliant::scene
