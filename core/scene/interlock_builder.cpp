#include "core/scene/interlock_builder.hpp"

#include "core/base/error.hpp"
#include "core/interlock/cell_surface.hpp"
#include "core/interlock/element_families.hpp"
#include "core/scene/composed_cell.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/unchecked_cell.hpp"

namespace pliant::scene {

namespace {

interlock::Rosette rosetteFrom(const Json& entry) {
  return {
      entry["ring_radius"], entry["wire_radius"], entry["distance"], entry["lean"], entry["spacing"], entry["aspect"]};
}

interlock::UnitCell cellFrom(const Json& entry, const std::string& pointer, const std::filesystem::path& directory) {
  const std::string type = entry["type"];
  if (type == "composed") return composedCell(entry, pointer, directory);
  if (type == "four_in_one")
    return interlock::fourInOne(
        {entry["ring_radius"], entry["wire_radius"], entry["width"], entry["height"], entry["tilt"], entry["aspect"]});
  if (type == "threefold") return interlock::threefold(rosetteFrom(entry));
  if (type == "square_rosette") return interlock::squareRosette(rosetteFrom(entry));
  if (type == "torus_knot")
    return interlock::torusKnot(
        {entry["p"], entry["q"], entry["a"], entry["b"], entry["c"], entry["wire_radius"], entry["spacing"]});
  if (type == "scale_mail")
    return interlock::scaleMail({rosetteFrom(entry), entry["plate_height"], entry["plate_inradius"],
                                 entry["plate_radius"], entry["hub_radius"]});
  return interlock::ringNet({entry["ring_radius"], entry["wire_radius"], entry["spacing"], entry["aspect"]});
}

interlock::UnitCell cellAt(const Scene& scene, std::size_t index) {
  const Json& cells = scene.normalized()["interlocking_cells"];
  interlock::UnitCell cell;
  const std::string pointer = childPointer("/interlocking_cells", index);
  locate(pointer, [&] {
    cell = cellFrom(cells[index], pointer, scene.directory());
    cell.name = cells[index]["name"];
    checkCell(cell);
    cell = supercell(cell, cells[index]["supercell"][0], cells[index]["supercell"][1]);
  });
  return cell;
}

}  // namespace

interlock::UnitCell buildCell(const Scene& scene, const std::string& name) {
  const Json& cells = scene.normalized()["interlocking_cells"];
  std::size_t index = 0;
  while (cells[index]["name"] != name) ++index;  // references have been checked
  try {
    return cellAt(scene, index);
  } catch (const base::InputError& error) {
    throw error.inside(scene.name());
  }
}

DraftCell draftCell(const Scene& scene, std::size_t index) {
  const Json& entry = scene.normalized()["interlocking_cells"][index];
  DraftCell draft;
  draft.cell = cellFrom(entry, childPointer("/interlocking_cells", index), scene.directory());
  draft.cell.name = entry["name"];
  draft.supercell = supercell(draft.cell, entry["supercell"][0], entry["supercell"][1]);
  return draft;
}

interlock::UnitCell uncheckedCell(const Json& entry, const std::string& pointer,
                                  const std::filesystem::path& directory) {
  return supercell(cellFrom(entry, pointer, directory), entry["supercell"][0], entry["supercell"][1]);
}

mechanics::Model cellPicture(const Scene& scene) {
  constexpr int cells = 3;
  const interlock::UnitCell cell = cellAt(scene, 0);
  const geometry::SurfaceMesh mesh = interlock::cellSurface(cell, interlock::restState(cell), cells, cells);
  mechanics::Model model;
  model.restPositions = mesh.points.reshaped();
  model.parts.push_back({cell.name, 0, model.nodeCount(), mesh.triangles, {}, {}, {}, {}});
  model.dofs.freeIndex.assign(static_cast<std::size_t>(model.coordinateCount()), -1);
  return model;
}

}  // namespace pliant::scene
