#pragma once

#include "core/scene/scene.hpp"

namespace pliant::document {

/// The scene with its relative paths (meshes and the like) rewritten so that they name the same files from `directory`.
scene::Scene relocated(const scene::Scene& scene, const std::filesystem::path& directory);

}  // namespace pliant::document
