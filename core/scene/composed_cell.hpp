#pragma once

#include <string>

#include "core/base/parameter_spec.hpp"
#include "core/interlock/unit_cell.hpp"

namespace pliant::scene {

/// The cell of a normalised entry of type "composed" at `pointer`. Its shapes are checked, the cell is not (see
/// checkCell). Throws base::InputError with the place of what is wrong.
interlock::UnitCell composedCell(const base::Json& entry, const std::string& pointer);

}  // namespace pliant::scene
