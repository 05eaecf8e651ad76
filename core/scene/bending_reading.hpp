#pragma once

#include "core/scene/bending_result.hpp"

namespace pliant::scene {

/// What studies of patches wrote into `directory`, for a scene with the same material. Throw base::InputError.
/// Where the elements are, and their contacts, too.
std::shared_ptr<BendingTestResult> readBendingTest(const Scene& scene, const std::filesystem::path& directory);
std::shared_ptr<GravityBendingResult> readGravityBending(const Scene& scene, const std::filesystem::path& directory);
/// Limits and what remains, without the states that they belong to.
std::shared_ptr<CurvatureLimitsResult> readCurvatureLimits(const Scene& scene, const std::filesystem::path& directory);
std::shared_ptr<BendingSizeResult> readBendingSize(const Scene& scene, const std::filesystem::path& directory);

}  // namespace pliant::scene
