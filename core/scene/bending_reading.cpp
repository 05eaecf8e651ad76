#include "core/scene/bending_reading.hpp"

#include <algorithm>

#include "core/scene/csv_table.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_head.hpp"
#include "core/scene/patch_study.hpp"

namespace pliant::scene {

namespace {

interlock::BendingKind bendingKindNamed(std::string_view name) {
  for (const auto kind : {interlock::BendingKind::locked, interlock::BendingKind::folded})
    if (nameOf(kind) == name) return kind;
  return interlock::BendingKind::unsettled;
}

/// The curvature (mean, deviator, twist) of a tensor (k_xx, k_yy, k_xy).
Eigen::Vector3d curvatureOf(double xx, double yy, double xy) { return {0.5 * (xx + yy), 0.5 * (xx - yy), xy}; }

std::vector<interlock::CellContactForce> readPatchContacts(const std::filesystem::path& file) {
  const CsvTable table(file);
  std::vector<interlock::CellContactForce> contacts;
  for (std::size_t i = 0; i < table.size(); ++i) {
    interlock::CellContactForce contact{};
    contact.pair.a = table.integer(i, "element_a");
    contact.pair.b = table.integer(i, "element_b");
    contact.gap = table.number(i, "gap [m]");
    contact.force = table.number(i, "force");
    contact.place = {table.number(i, "x [m]"), table.number(i, "y [m]"), table.number(i, "z [m]")};
    contact.normal = {table.number(i, "normal_x"), table.number(i, "normal_y"), table.number(i, "normal_z")};
    contacts.push_back(contact);
  }
  return contacts;
}

/// The patch that the study's options cut out of the cell, and the elements' places in it.
void readConfiguration(const std::filesystem::path& directory, PatchResult& result, interlock::CellEquilibrium& rest) {
  result.patch = locate(directory.string(), [&] {
    return std::make_shared<const interlock::UnitCell>(cutPatch(*result.cell, patchOutline(result.provenance.options)));
  });
  rest.state = readElementTable(directory / "elements.csv", *result.patch);
  rest.contacts = readPatchContacts(directory / "contacts.csv");
}

/// What summary.json says of any equilibrium.
void readRest(const Json& summary, interlock::CellEquilibrium& rest) {
  rest.termination = limitTerminationNamed(summary.at("termination").get<std::string>());
  rest.message = summary.at("message");
  rest.remaining = summary.at("remaining");
  rest.meanGap = summary.at("mean_gap");
  rest.smallestGap = summary.at("smallest_gap");
  rest.iterations = summary.at("iterations");
}

interlock::BendingLimit limitFrom(const CsvTable& table, std::size_t row) {
  interlock::BendingLimit limit;
  limit.kind = bendingKindNamed(table.text(row, "outcome"));
  limit.curvature = table.number(row, "curvature [1/m]");
  limit.orthogonal = table.number(row, "orthogonal_curvature [1/m]");
  limit.remoteShare = table.number(row, "remote_share");
  limit.steepest = table.number(row, "steepest_slope");
  interlock::CellEquilibrium& rest = limit.equilibrium;
  rest.termination = limitTerminationNamed(table.text(row, "termination"));
  rest.remaining = table.number(row, "remaining [1/m]");
  rest.meanGap = table.number(row, "mean_gap [m]");
  rest.iterations = table.integer(row, "iterations");
  rest.state.strain =
      curvatureOf(table.number(row, "k_xx [1/m]"), table.number(row, "k_yy [1/m]"), table.number(row, "k_xy [1/m]"));
  return limit;
}

}  // namespace

std::shared_ptr<BendingTestResult> readBendingTest(const Scene& scene, const std::filesystem::path& directory) {
  return readInterlockResult<BendingTestResult>(directory, [&](BendingTestResult& result) {
    const Json summary = readInterlockHead(scene, directory, "bending_test", result);
    readConfiguration(directory, result, result.limit.equilibrium);
    readRest(summary, result.limit.equilibrium);
    const Json& tensor = summary.at("curvature_tensor");
    result.limit.equilibrium.state.strain = curvatureOf(tensor.at(0), tensor.at(1), tensor.at(2));
    result.limit.angle = summary.at("direction");
    result.limit.kind = bendingKindNamed(summary.at("outcome").get<std::string>());
    result.limit.curvature = summary.at("reached").at("curvature");
    result.limit.orthogonal = summary.at("reached").at("orthogonal_curvature");
    result.limit.remoteShare = summary.at("remote_share");
    result.limit.steepest = summary.at("steepest_slope");
  });
}

std::shared_ptr<GravityBendingResult> readGravityBending(const Scene& scene, const std::filesystem::path& directory) {
  return readInterlockResult<GravityBendingResult>(directory, [&](GravityBendingResult& result) {
    const Json summary = readInterlockHead(scene, directory, "gravity_bending", result);
    readConfiguration(directory, result, result.rest);
    readRest(summary, result.rest);
    for (const auto kind : {interlock::RestKind::locked, interlock::RestKind::reached, interlock::RestKind::unlimited})
      if (nameOf(kind) == summary.at("rest").get<std::string>()) result.rest.kind = kind;
    const Json& options = result.provenance.options;
    result.direction = summary.at("direction");
    result.clamped = clampedElements(*result.patch, result.direction, options.at("clamped_width"));
    result.weight = summary.at("weight");
    for (int i = 0; i < 3; ++i) {
      result.gravity[i] = options.at("gravity").at(static_cast<std::size_t>(i));
      result.reaction[i] = summary.at("reaction").at(static_cast<std::size_t>(i));
    }
  });
}

std::shared_ptr<CurvatureLimitsResult> readCurvatureLimits(const Scene& scene, const std::filesystem::path& directory) {
  return readInterlockResult<CurvatureLimitsResult>(directory, [&](CurvatureLimitsResult& result) {
    readInterlockHead(scene, directory, "curvature_limits", result);
    const CsvTable table(directory / "curvature_limits.csv");
    for (std::size_t row = 0; row + 1 < table.size(); row += 2) {
      interlock::BendingLimits& limits = result.directions.emplace_back();
      limits.up = limitFrom(table, row);
      limits.down = limitFrom(table, row + 1);
      limits.up.angle = limits.down.angle = table.number(row, "direction [rad]");
    }
  });
}

std::shared_ptr<BendingSizeResult> readBendingSize(const Scene& scene, const std::filesystem::path& directory) {
  return readInterlockResult<BendingSizeResult>(directory, [&](BendingSizeResult& result) {
    readInterlockHead(scene, directory, "bending_size", result);
    const CsvTable table(directory / "bending_size.csv");
    constexpr std::size_t tests = BendingSizeResult::names.size();
    for (std::size_t row = 0; row + tests <= table.size(); row += tests) {
      BendingSizeResult::Size& size = result.sizes.emplace_back();
      size.radius = table.number(row, "radius [m]");
      size.elements = table.integer(row, "elements");
      for (std::size_t test = 0; test < tests; ++test) {
        size.limits[test] = limitFrom(table, row + test);
        size.limits[test].angle = result.provenance.options.at("direction");
      }
    }
  });
}

}  // namespace pliant::scene
