#pragma once

#include <filesystem>
#include <string>

#include "core/base/parameter_spec.hpp"
#include "core/interlock/unit_cell.hpp"

namespace pliant::scene {

/// The supercell of a normalised entry of "interlocking_cells" at `pointer`, with mesh files relative to `directory`.
/// Only its shapes are checked, where a mesh is read. Throws base::InputError.
interlock::UnitCell uncheckedCell(const base::Json& entry, const std::string& pointer,
                                  const std::filesystem::path& directory);

}  // namespace pliant::scene
