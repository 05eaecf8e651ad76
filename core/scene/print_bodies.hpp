#pragma once

#include <filesystem>

#include "core/geometry/implicit_surface.hpp"
#include "core/geometry/print_files.hpp"
#include "core/scene/patch_export.hpp"

namespace pliant::scene {

/// Writes copies of bodies, named by their number, as STL, 3MF or another mesh file, moved so that their box begins at
/// the origin, and adds to the report what was written.
void writeBodies(const std::vector<geometry::BodyMesh>& bodies, std::vector<geometry::BodyCopy> copies,
                 const std::filesystem::path& file, PatchReport& report, base::ExecutionContext& context);

}  // namespace pliant::scene
