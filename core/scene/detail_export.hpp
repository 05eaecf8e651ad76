#pragma once

#include "core/scene/macro_result.hpp"
#include "core/scene/patch_export.hpp"

namespace pliant::scene {

/// Writes the placed elements of a sheet for a printer, as exportPatch does. Throws base::InputError if the result has
/// none, if they do not hold (DetailCheck), or are nearer than `minimumClearance` [m].
PatchReport exportPlaced(const MacroResult& result, double tolerance, double minimumClearance,
                         const std::filesystem::path& file, base::ExecutionContext& context);

}  // namespace pliant::scene
