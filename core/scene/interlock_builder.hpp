#pragma once

#include <string>

#include "core/interlock/unit_cell.hpp"
#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// The entry of "interlocking_cells" with this name, checked. Throws base::InputError with its place in the file.
interlock::UnitCell buildCell(const Scene& scene, const std::string& name);

/// The entry with this number (from 0) as it is, which may overlap or be linked otherwise than it should: for an editor
/// that shows what is wrong.
struct DraftCell {
  interlock::UnitCell cell;
  interlock::UnitCell supercell;  ///< that studies would compute with
};
DraftCell draftCell(const Scene& scene, std::size_t index);

/// What to draw of a scene of interlocking cells alone: 3 x 3 cells of its first material at rest. Nothing of it can
/// move, for what is computed with is the UnitCell. Throws as buildCell, without the scene's name.
mechanics::Model cellPicture(const Scene& scene);

}  // namespace pliant::scene
