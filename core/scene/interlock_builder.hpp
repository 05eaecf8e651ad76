#pragma once

#include <string>

#include "core/interlock/unit_cell.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// The entry of "interlocking_cells" with this name, checked. Throws base::InputError with its place in the file.
interlock::UnitCell buildCell(const Scene& scene, const std::string& name);

}  // namespace pliant::scene
