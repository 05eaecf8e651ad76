#include "core/scene/macro_reading.hpp"

#include "core/scene/body_builder.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/interlock_head.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_placement.hpp"
#include "core/scene/native_patch.hpp"

namespace pliant::scene {

using Eigen::Index;

namespace {

void readNative(const std::filesystem::path& directory, const Json& summary, MacroResult& result) {
  NativeComparison& native = result.native.emplace();
  native.meanDistance = summary.at("mean_distance");
  native.largestDistance = summary.at("largest_distance");
  native.size = summary.at("size");
  native.compared = summary.at("compared");
  native.rest.termination = limitTerminationNamed(summary.at("termination").get<std::string>());
  if (std::filesystem::exists(directory / "native.csv")) {
    native.patch = std::make_shared<const interlock::UnitCell>(nativePatchOf(*result.cell, result.provenance.options));
    native.rest.state = readElementTable(directory / "native.csv", *native.patch);
    return;
  }
  const CsvTable elements(directory / "elements.csv");  // of a version that did not write how they turn
  native.rest.state.positions.resize(3, static_cast<Index>(elements.size()));
  for (std::size_t i = 0; i < elements.size(); ++i)
    native.rest.state.positions.col(static_cast<Index>(i)) << elements.number(i, "x [m]"), elements.number(i, "y [m]"),
        elements.number(i, "z [m]");
}

}  // namespace

std::shared_ptr<MacroResult> readMacro(const Scene& scene, const std::filesystem::path& directory) {
  const std::string type = parseJson(readTextFile(directory / "summary.json")).value("type", "");
  return readInterlockResult<MacroResult>(directory, [&](MacroResult& result) {
    const Json summary = readInterlockHead(scene, directory, type, result);
    if (!summary.at("elements").is_null())
      result.cell = placedCell(scene, result.provenance.options, directory.string(), result.cell);
    auto sheet = std::make_shared<interlock::MacroSheet>();
    interlock::MacroState& state = result.state;
    const CsvTable nodes(directory / "nodes.csv");
    const auto nodeCount = static_cast<Index>(nodes.size());
    sheet->mesh.points.setZero(3, nodeCount);
    state.positions.resize(3 * nodeCount);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const auto column = static_cast<Index>(node);
      sheet->mesh.points(0, column) = nodes.number(node, "rest_x [m]");
      sheet->mesh.points(1, column) = nodes.number(node, "rest_y [m]");
      state.positions.segment<3>(3 * column) << nodes.number(node, "x [m]"), nodes.number(node, "y [m]"),
          nodes.number(node, "z [m]");
    }
    const CsvTable triangles(directory / "triangles.csv");
    const auto count = static_cast<Index>(triangles.size());
    state.stretchGauge.resize(count);
    state.bendingGauge.resize(count);
    state.strains.stretch.resize(3, count);
    state.strains.curvature.resize(3, count);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto column = static_cast<Index>(t);
      auto& corners = sheet->mesh.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = triangles.integer(t, std::string(1, "abc"[i]));
        if (corners[i] < 0 || corners[i] >= nodeCount)
          throw base::InputError((directory / "triangles.csv").string(),
                                 "Triangle " + std::to_string(t) + " names node " + std::to_string(corners[i]) +
                                     ", which nodes.csv does not have.");
      }
      state.strains.stretch.col(column) << triangles.number(t, "strain_mean"), triangles.number(t, "strain_deviator"),
          triangles.number(t, "strain_shear");
      state.strains.curvature.col(column) << triangles.number(t, "curvature_mean [1/m]"),
          triangles.number(t, "curvature_deviator [1/m]"), triangles.number(t, "curvature_twist [1/m]");
      state.stretchGauge[column] = triangles.number(t, "stretch_gauge");
      state.bendingGauge[column] = triangles.number(t, "bending_gauge");
    }
    sheet->materials.emplace_back();
    result.sheet = std::move(sheet);
    result.clamped = summary.at("clamped").get<std::vector<int>>();
    result.loaded = summary.value("loaded", std::vector<int>());
    state.violation = summary.at("violation");
    state.work = summary.at("work");
    state.remaining = summary.at("remaining");
    const Json& deflections = summary.at("deflections");
    result.deflections.resize(3, static_cast<Index>(deflections.size()));
    for (std::size_t i = 0; i < deflections.size(); ++i)
      for (int k = 0; k < 3; ++k) result.deflections(k, static_cast<Index>(i)) = deflections[i][k];
    result.bodies = buildBodies(scene);
    if (!summary.at("elements").is_null()) result.placed = readPlaced(directory, summary.at("elements"));
    const Json& native = summary.at("native");
    if (!native.is_null()) readNative(directory, native, result);
    if (result.isMotion()) readMacroSteps(directory, result);
    if (std::filesystem::exists(directory / "frames.csv")) readMacroFrames(directory, result);
  });
}

}  // namespace pliant::scene
