#pragma once

#include <filesystem>
#include <string>

#include "core/base/parameter_spec.hpp"
#include "core/interlock/unit_cell.hpp"

namespace pliant::scene {

/// The cell of a normalised entry of type "composed" at `pointer`, with mesh files relative to `directory`. Its shapes
/// are checked, the cell is not (see checkCell). Throws base::InputError with the place of what is wrong.
interlock::UnitCell composedCell(const base::Json& entry, const std::string& pointer,
                                 const std::filesystem::path& directory);

}  // namespace pliant::scene
