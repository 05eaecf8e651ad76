#pragma once

#include <functional>
#include <span>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

using base::Json;

/// Rewrites a scene of version `from` as one of version `from` + 1 (all but "schema_version", which is counted up).
struct MigrationStep {
  int from = 0;
  std::function<void(Json&)> apply;
};

/// The scene in version `newest`, step by step. Throws base::InputError if "schema_version" is missing, no whole
/// number, newer than `newest`, or older than the steps reach.
Json migrate(Json scene, std::span<const MigrationStep> steps, int newest);

/// The steps from older versions of the format to `schemaVersion`.
std::span<const MigrationStep> migrationSteps();

}  // namespace pliant::scene
