#pragma once

#include <filesystem>
#include <optional>

#include "core/scene/scene.hpp"

namespace pliant::panels {

/// Outlines that a large piece is given by a click.
enum class SheetOutline { disk, square, hexagon };

/// The study of a large piece, as the scene has it, without regions that name triangles, with this outline, `extent`
/// [m] across, with `rings` as of a disk.
scene::Json withOutline(scene::Json study, SheetOutline outline, double extent, int rings);
/// The same with what a file has: a polygon (CSV, OBJ), or a flat mesh (PLY, STL), which is as fine as it is. The file
/// is named relative to the scene's folder, if that is known. Without the native patch, which only simple outlines
/// have.
scene::Json withOutlineFrom(scene::Json study, const std::filesystem::path& file, const std::filesystem::path& folder);

/// Of a study whose keys have all their values: rings as of a disk, and how far it is across as far as its keys say
/// [m].
int ringsOf(const scene::Json& study);
std::optional<double> extentOf(const scene::Json& study);

}  // namespace pliant::panels
