#pragma once

#include "core/scene/macro_result.hpp"

namespace pliant::scene {

/// What a `macro_equilibrium` wrote into `directory`, for a scene with the same material: where the sheet is and how
/// near its limits; of a native patch the origins of its elements. Throws base::InputError.
std::shared_ptr<MacroResult> readMacro(const Scene& scene, const std::filesystem::path& directory);

}  // namespace pliant::scene
