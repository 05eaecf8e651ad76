#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factories of studies of finite patches, see StudyRegistry.
std::unique_ptr<Study> makeBendingTestStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);
std::unique_ptr<Study> makeCurvatureLimitsStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                const Json& options);
std::unique_ptr<Study> makeBendingSizeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);
std::unique_ptr<Study> makeBendingBoundaryStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                const Json& options);
std::unique_ptr<Study> makeGravityBendingStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                               const Json& options);

}  // namespace pliant::scene
