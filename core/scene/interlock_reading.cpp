#include "core/scene/interlock_reading.hpp"

#include "core/scene/csv_table.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/interlock_head.hpp"

namespace pliant::scene {

namespace {

interlock::CellState readState(const std::filesystem::path& file, const interlock::UnitCell& cell,
                               const Json& stretch) {
  interlock::CellState state = readElementTable(file, cell);
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
  return readInterlockResult<CellTestResult>(directory, [&](CellTestResult& result) {
    const Json summary = readInterlockHead(scene, directory, "cell_test", result);
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
  return readInterlockResult<FreeTravelResult>(directory, [&](FreeTravelResult& result) {
    readInterlockHead(scene, directory, "free_travel", result);
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
