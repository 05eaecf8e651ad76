#include "core/scene/interlock_reading.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

base::TerminationType limitTerminationNamed(std::string_view name) {
  for (const auto type : {base::TerminationType::converged, base::TerminationType::cancelled,
                          base::TerminationType::iterationLimit, base::TerminationType::infeasible})
    if (base::toString(type) == name) return type;
  return base::TerminationType::failed;
}

/// The summary's head; the cell is that of the scene.
Json readHead(const Scene& scene, const std::filesystem::path& directory, std::string_view type,
              InterlockResult& result) {
  Json summary = parseJson(readTextFile(directory / "summary.json"));
  const std::string name = summary.at("cell");
  const Json& cells = scene.normalized().at("interlocking_cells");
  if (summary.at("type") != type ||
      std::none_of(cells.begin(), cells.end(), [&](const Json& cell) { return cell.at("name") == name; }))
    throw InputError(directory.string(), "This is no result of a " + std::string(type) + " study of this scene.");
  result.cell = std::make_shared<const interlock::UnitCell>(buildCell(scene, name));
  result.termination = limitTerminationNamed(summary.at("termination").get<std::string>());
  result.message = summary.at("message");
  result.seconds = summary.at("seconds");
  const Json& from = summary.at("provenance");
  result.provenance = {
      from.at("version"), from.at("scene"), from.at("scene_hash"), summary.at("study"), from.at("options")};
  return summary;
}

template <class AnyResult, class Read>
std::shared_ptr<AnyResult> readResult(const std::filesystem::path& directory, const Read& read) {
  auto result = std::make_shared<AnyResult>();
  try {
    read(*result);
  } catch (const Json::exception&) {
    throw InputError(
        (directory / "summary.json").string(), "This summary lacks what such a result has; run its study again.");
  }
  return result;
}

interlock::CellState readState(const std::filesystem::path& file, const interlock::UnitCell& cell,
                               const Json& stretch) {
  const CsvTable table(file);
  if (table.size() != cell.elements.size())
    throw InputError(file.string(), "There are " + std::to_string(table.size()) + " elements, but the cell has " +
                                        std::to_string(cell.elements.size()) + "; run the study again.");
  interlock::CellState state = interlock::restState(cell);
  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < table.size(); ++i)
    for (int row = 0; row < 3; ++row) {
      const std::string& name = axes[static_cast<std::size_t>(row)];
      state.positions(row, static_cast<Eigen::Index>(i)) = table.number(i, name + " [m]");
      for (int column = 0; column < 3; ++column)
        state.rotations[i](row, column) = table.number(i, "rotation_" + name + axes[static_cast<std::size_t>(column)]);
    }
  const double x = stretch.at("x"), y = stretch.at("y"), xy = stretch.at("xy");
  state.strain = {0.5 * (x + y) - 1, 0.5 * (x - y), xy};
  return state;
}

std::vector<interlock::CellContactForce> readContacts(const std::filesystem::path& file) {
  const CsvTable table(file);
  std::vector<interlock::CellContactForce> contacts;
  for (std::size_t i = 0; i < table.size(); ++i) {
    interlock::CellContactForce contact{};
    contact.pair.a = table.integer(i, "element_a");
    contact.pair.b = table.integer(i, "element_b");
    contact.pair.shift = {table.integer(i, "shift_1"), table.integer(i, "shift_2")};
    contact.gap = table.number(i, "gap [m]");
    contact.force = table.number(i, "force [strain/m]");
    contact.place = {table.number(i, "x [m]"), table.number(i, "y [m]"), table.number(i, "z [m]")};
    contact.normal = {table.number(i, "normal_x"), table.number(i, "normal_y"), table.number(i, "normal_z")};
    contacts.push_back(contact);
  }
  return contacts;
}

}  // namespace

std::shared_ptr<CellTestResult> readCellTest(const Scene& scene, const std::filesystem::path& directory) {
  return readResult<CellTestResult>(directory, [&](CellTestResult& result) {
    const Json summary = readHead(scene, directory, "cell_test", result);
    result.limit.angle = summary.at("direction");
    result.limit.strain = summary.at("strain");
    interlock::CellEquilibrium& rest = result.limit.equilibrium;
    rest.termination =
        result.termination == base::TerminationType::infeasible ? base::TerminationType::converged : result.termination;
    rest.message = result.message;
    for (const auto kind : {interlock::RestKind::locked, interlock::RestKind::reached, interlock::RestKind::unlimited})
      if (nameOf(kind) == summary.at("rest").get<std::string>()) rest.kind = kind;
    rest.remaining = summary.at("remaining");
    rest.meanGap = summary.at("mean_gap");
    rest.smallestGap = summary.at("smallest_gap");
    rest.iterations = summary.at("iterations");
    rest.state = readState(directory / "elements.csv", *result.cell, summary.at("stretch"));
    rest.contacts = readContacts(directory / "contacts.csv");
  });
}

std::shared_ptr<FreeTravelResult> readFreeTravel(const Scene& scene, const std::filesystem::path& directory) {
  return readResult<FreeTravelResult>(directory, [&](FreeTravelResult& result) {
    readHead(scene, directory, "free_travel", result);
    const CsvTable table(directory / "free_travel.csv");
    for (std::size_t i = 0; i < table.size(); ++i) {
      interlock::FreeTravel direction;
      for (auto* limit : {&direction.stretch, &direction.compression}) {
        const std::string name = limit == &direction.stretch ? "stretch" : "compression";
        limit->angle = table.number(i, "direction [rad]");
        limit->strain = table.number(i, name);
        limit->equilibrium.remaining = table.number(i, name + "_remaining");
        limit->equilibrium.termination = limitTerminationNamed(table.text(i, name + "_termination"));
      }
      result.directions.push_back(std::move(direction));
    }
  });
}

}  // namespace pliant::scene
