#pragma once

#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// What a `cell_test` study wrote into `directory`, for a scene with the same cell: where its elements are, and its
/// contacts. Throws base::InputError.
std::shared_ptr<CellTestResult> readCellTest(const Scene& scene, const std::filesystem::path& directory);

/// What a `free_travel` study wrote into `directory`: limits and what remains, without the states that they belong to.
/// Throws base::InputError.
std::shared_ptr<FreeTravelResult> readFreeTravel(const Scene& scene, const std::filesystem::path& directory);

}  // namespace pliant::scene
