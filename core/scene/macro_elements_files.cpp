#include <Eigen/Geometry>

#include "core/interlock/cell_surface.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/interlock_head.hpp"
#include "core/scene/macro_result.hpp"
#include "core/scene/result_folder.hpp"

namespace pliant::scene {

using Eigen::Index;

namespace {

Json checkSummary(const interlock::DetailCheck& check) {
  return {{"pairs", check.pairs},
          {"links", check.links},
          {"lost_links", check.lostLinks},
          {"new_links", check.newLinks},
          {"smallest_distance", check.smallestDistance},
          {"holds", check.holds()}};
}

interlock::DetailCheck checkFrom(const Json& json) {
  return {
      json.at("pairs"), json.at("links"), json.at("lost_links"), json.at("new_links"), json.at("smallest_distance")};
}

}  // namespace

Json placedSummary(const PlacedElements& placed) {
  const interlock::SheetDetail& detail = placed.detail;
  return {{"termination", base::toString(detail.termination)},
          {"message", detail.message},
          {"elements", detail.elements.size()},
          {"left_out", detail.leftOut},
          {"reached", detail.reached},
          {"largest_pull", detail.pulls.maxCoeff()},
          {"mean_pull", detail.pulls.mean()},
          {"largest_turn", detail.turns.maxCoeff()},
          {"smallest_gap", detail.smallestGap},
          {"last_move", detail.lastMove},
          {"steps", detail.steps},
          {"sweeps", detail.sweeps},
          {"carried_together", detail.jams},
          {"before", checkSummary(placed.before)},
          {"after", checkSummary(placed.check)},
          {"seconds", detail.seconds},
          {"units",
           {{"largest_pull", "m, from where the sheet wants an element"},
            {"largest_turn", "rad, the same of its turn"},
            {"smallest_gap", "m, or the range of the barrier if that is less"},
            {"last_move", "m, of the farthest element in the last sweep"},
            {"smallest_distance", "m: no two elements are nearer, found without the contact that placed them"}}}};
}

void MacroResult::writeNative(ResultFolder& folder) const {
  CsvWriter elements;
  for (const char* column : {"element", "rest_x [m]", "rest_y [m]", "x [m]", "y [m]", "z [m]"}) elements.add(column);
  elements.endRow();
  for (std::size_t i = 0; i < native->patch->elements.size(); ++i) {
    const Eigen::Vector3d& rest = native->patch->elements[i].position;
    elements.add(static_cast<long>(i)).add(rest.x()).add(rest.y());
    for (int k = 0; k < 3; ++k) elements.add(native->rest.state.positions(k, static_cast<Index>(i)));
    elements.endRow();
  }
  folder.writeFile("elements.csv", elements.text());
  folder.writeFile("native.csv", elementTable(native->rest.state));
  geometry::writeMesh(cellSurface(*native->patch, native->rest.state, 1, 1, 0.2), folder.path("patch.ply"));
}

void MacroResult::writePlaced(ResultFolder& folder) const {
  CsvWriter csv;
  for (const char* column : {"element", "shift_first", "shift_second", "x [m]", "y [m]", "z [m]", "q_w", "q_x", "q_y",
                             "q_z", "pull [m]", "turn [rad]"})
    csv.add(column);
  csv.endRow();
  const interlock::SheetDetail& detail = placed->detail;
  for (std::size_t i = 0; i < detail.elements.size(); ++i) {
    const auto column = static_cast<Index>(i);
    csv.add(detail.elements[i].element).add(detail.elements[i].shift[0]).add(detail.elements[i].shift[1]);
    for (int k = 0; k < 3; ++k) csv.add(detail.state.positions(k, column));
    const Eigen::Quaterniond turn(detail.state.rotations[i]);
    csv.add(turn.w()).add(turn.x()).add(turn.y()).add(turn.z()).add(detail.pulls[column]).add(detail.turns[column]);
    csv.endRow();
  }
  folder.writeFile("placed_elements.csv", csv.text());
}

PlacedElements readPlaced(const std::filesystem::path& directory, const Json& summary) {
  const CsvTable table(directory / "placed_elements.csv");
  PlacedElements placed;
  interlock::SheetDetail& detail = placed.detail;
  const auto count = static_cast<Index>(table.size());
  detail.state.positions.resize(3, count);
  detail.pulls.resize(count);
  detail.turns.resize(count);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto column = static_cast<Index>(i);
    detail.elements.push_back(
        {table.integer(i, "element"), {table.integer(i, "shift_first"), table.integer(i, "shift_second")}});
    detail.state.positions.col(column) << table.number(i, "x [m]"), table.number(i, "y [m]"), table.number(i, "z [m]");
    const Eigen::Quaterniond turn(
        table.number(i, "q_w"), table.number(i, "q_x"), table.number(i, "q_y"), table.number(i, "q_z"));
    detail.state.rotations.push_back(turn.normalized().toRotationMatrix());
    detail.pulls[column] = table.number(i, "pull [m]");
    detail.turns[column] = table.number(i, "turn [rad]");
  }
  detail.termination = limitTerminationNamed(summary.at("termination").get<std::string>());
  detail.message = summary.at("message");
  detail.leftOut = summary.at("left_out");
  detail.reached = summary.at("reached");
  detail.smallestGap = summary.at("smallest_gap");
  detail.lastMove = summary.at("last_move");
  detail.steps = summary.at("steps");
  detail.sweeps = summary.at("sweeps");
  detail.jams = summary.at("carried_together");
  detail.seconds = summary.at("seconds");
  placed.before = checkFrom(summary.at("before"));
  placed.check = checkFrom(summary.at("after"));
  return placed;
}

}  // namespace pliant::scene
