#include "core/scene/interlock_builder.hpp"

#include "core/base/error.hpp"
#include "core/interlock/element_families.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

namespace {

interlock::Rosette rosetteFrom(const Json& entry) {
  return {entry["ring_radius"], entry["wire_radius"], entry["distance"], entry["lean"], entry["spacing"]};
}

interlock::UnitCell cellFrom(const Json& entry) {
  const std::string type = entry["type"];
  if (type == "four_in_one")
    return interlock::fourInOne(
        {entry["ring_radius"], entry["wire_radius"], entry["width"], entry["height"], entry["tilt"]});
  if (type == "threefold") return interlock::threefold(rosetteFrom(entry));
  if (type == "square_rosette") return interlock::squareRosette(rosetteFrom(entry));
  if (type == "torus_knot")
    return interlock::torusKnot(
        {entry["p"], entry["q"], entry["a"], entry["b"], entry["c"], entry["wire_radius"], entry["spacing"]});
  if (type == "scale_mail")
    return interlock::scaleMail({rosetteFrom(entry), entry["plate_height"], entry["plate_inradius"],
                                 entry["plate_radius"], entry["hub_radius"]});
  return interlock::ringNet({entry["ring_radius"], entry["wire_radius"], entry["spacing"]});
}

}  // namespace

interlock::UnitCell buildCell(const Scene& scene, const std::string& name) {
  const Json& cells = scene.normalized()["interlocking_cells"];
  std::size_t index = 0;
  while (cells[index]["name"] != name) ++index;  // references have been checked
  interlock::UnitCell cell;
  locate(scene.name() + ": " + childPointer("/interlocking_cells", index), [&] {
    cell = cellFrom(cells[index]);
    cell.name = name;
    checkCell(cell);
    cell = supercell(cell, cells[index]["supercell"][0], cells[index]["supercell"][1]);
  });
  return cell;
}

}  // namespace pliant::scene
