#include "core/scene/macro_result.hpp"

#include <cmath>

#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

namespace {

/// Above which friction at rest is warned of, see SheetFriction.
constexpr double largestLag = 0.05;

Json columnsOf(const Eigen::Matrix3Xd& vectors) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < vectors.cols(); ++i) list.push_back({vectors(0, i), vectors(1, i), vectors(2, i)});
  return list;
}

Json setSummary(const std::shared_ptr<const mechanics::AdmissibleStrainSet>& set, const Eigen::VectorXd& gauges) {
  if (!set || gauges.size() == 0) return nullptr;
  return {{"largest_gauge", gauges.maxCoeff()},
          {"triangles_near_limit", (gauges.array() > 0.99).count()},
          {"limits", set->boundary().points.cols()},
          {"size", set->size()},
          {"gauge_error", {{"largest", set->gaugeError().largest}, {"rms", set->gaugeError().rootMeanSquare}}}};
}

}  // namespace

Json MacroResult::summary() const {
  Json json = summaryHead(*this);
  json["cell"] = cell->name;
  json["nodes"] = sheet->mesh.points.cols();
  json["triangles"] = sheet->mesh.triangles.size();
  json["clamped"] = clamped;
  json["loaded"] = loaded;
  json["iterations"] = state.report.iterations.empty() ? 0 : state.report.iterations.size() - 1;
  json["residual"] = state.report.residual();
  json["work"] = state.work;
  json["remaining"] = state.remaining;
  json["violation"] = state.violation;
  json["stretch"] = setSummary(sheet->materials.front().stretch, gaugesOf(0, state.stretchGauge));
  json["bending"] = setSummary(sheet->materials.front().bending, gaugesOf(0, state.bendingGauge));
  json["regions"] = Json::array();
  for (std::size_t i = 1; i < sheet->materials.size(); ++i) {
    const int number = static_cast<int>(i);
    json["regions"].push_back(
        {{"triangles", gaugesOf(number, state.stretchGauge).size()},
         {"stretch", setSummary(sheet->materials[i].stretch, gaugesOf(number, state.stretchGauge))},
         {"bending", setSummary(sheet->materials[i].bending, gaugesOf(number, state.bendingGauge))}});
  }
  json["contact"] = nullptr;
  if (std::isfinite(state.smallestGap))
    json["contact"] = {{"smallest_gap", state.smallestGap},
                       {"supported", state.supported},
                       {"friction",
                        {{"contacts", state.friction.contacts},
                         {"sliding_share", state.friction.slidingShare},
                         {"lag", state.friction.lag},
                         {"increments", state.increments}}}};
  if (isMotion()) addMotion(json);
  json["elements"] = placed ? placedSummary(*placed) : Json(nullptr);
  json["deflections"] = columnsOf(deflections);
  json["largest_displacement"] =
      (state.positions.reshaped(3, sheet->mesh.points.cols()) - sheet->mesh.points).colwise().norm().maxCoeff();
  json["native"] = nullptr;
  if (native)
    json["native"] = {{"termination", base::toString(native->rest.termination)},
                      {"elements", native->patch->elements.size()},
                      {"deflections", columnsOf(native->deflections)},
                      {"compared", native->compared},
                      {"mean_distance", native->meanDistance},
                      {"largest_distance", native->largestDistance},
                      {"size", native->size},
                      {"mean_distance_over_size", native->meanDistance / native->size},
                      {"mean_gap", native->rest.meanGap},
                      {"iterations", native->rest.iterations},
                      {"seconds", native->seconds}};
  json["units"] = {{"work", "J"},
                   {"remaining", "J, that the barrier could still yield, to first order"},
                   {"violation", "distance outside a limit over the size of its set"},
                   {"deflections", "m, of what carries the loads"},
                   {"largest_displacement", "m"},
                   {"largest_gauge", "1 at the limit"},
                   {"gauge_error", "of the smooth gauge between limits, against flat triangles"},
                   {"mean_distance", "m, between elements and the sheet"},
                   {"smallest_gap", "m, between the sheet and bodies and itself"},
                   {"supported", "N, of the bodies against gravity"},
                   {"sliding_share", "of the forces of contacts, those of contacts that slide"},
                   {"lag", "how much friction would change with the last contacts, over the largest there can be"},
                   {"dissipated", "J, by friction"},
                   {"largest_grip_lag", "m, of nodes behind their grips"},
                   {"energy", "J, of all, at the end"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

bool MacroResult::isMotion() const { return provenance.options.value("type", "") == "macro_motion"; }

Eigen::VectorXd MacroResult::gaugesOf(int material, const Eigen::VectorXd& gauges) const {
  if (sheet->materialOf.empty()) return gauges;
  std::vector<int> own;
  for (std::size_t t = 0; t < sheet->materialOf.size(); ++t)
    if (sheet->materialOf[t] == material) own.push_back(static_cast<int>(t));
  return gauges(own);
}

void MacroResult::addMotion(Json& json) const {
  double smallestGap = std::numeric_limits<double>::infinity(), stretch = 0, bending = 0, lag = 0, residual = 0,
         frictionLag = 0;
  for (const MacroStepRecord& step : steps) {
    smallestGap = std::min(smallestGap, step.smallestGap);
    stretch = std::max(stretch, step.stretchGauge);
    bending = std::max(bending, step.bendingGauge);
    lag = std::max(lag, step.gripLag);
    residual = std::max(residual, step.residual);
    frictionLag = std::max(frictionLag, step.friction.lag);
  }
  json["motion"] = {{"steps", steps.size()},
                    {"frames", frames.size()},
                    {"largest_stretch_gauge", stretch},
                    {"largest_bending_gauge", bending},
                    {"largest_grip_lag", lag},
                    {"largest_residual", residual},
                    {"largest_friction_lag", frictionLag},
                    {"dissipated", steps.empty() ? 0 : steps.back().energies.dissipated}};
  json["motion"]["smallest_gap"] = std::isfinite(smallestGap) ? Json(smallestGap) : Json(nullptr);
  json["motion"]["end_time"] = steps.empty() ? 0 : steps.back().time;
  json["motion"]["energy"] = steps.empty() ? 0 : steps.back().energies.total();
}

std::vector<std::string> MacroResult::warnings() const {
  std::vector<std::string> list;
  if (clamped.empty() && bodies.empty() && !isMotion())
    list.emplace_back("Nothing is clamped: only limits and inertia say where the sheet is.");
  if (!isMotion() && state.friction.lag > largestLag)
    list.push_back("Friction has not settled: with the contacts of the end it would change by " +
                   std::to_string(std::lround(100 * state.friction.lag)) + " % of the largest it can be.");
  if (placed && placed->detail.termination != base::TerminationType::converged)
    list.push_back("Elements are not all where the sheet wants them: " + placed->detail.message);
  if (placed && !placed->check.holds())
    list.emplace_back("The placed elements do not hold: some may overlap, or are linked otherwise than at rest.");
  if (native && !native->rest.converged())
    list.push_back("The native patch did not come to rest: " + native->rest.message);
  return list;
}

void MacroResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  const auto positions = state.positions.reshaped(3, sheet->mesh.points.cols());
  CsvWriter nodes;
  for (const char* column : {"node", "rest_x [m]", "rest_y [m]", "x [m]", "y [m]", "z [m]"}) nodes.add(column);
  nodes.endRow();
  for (Eigen::Index node = 0; node < positions.cols(); ++node) {
    nodes.add(static_cast<long>(node)).add(sheet->mesh.points(0, node)).add(sheet->mesh.points(1, node));
    for (int i = 0; i < 3; ++i) nodes.add(positions(i, node));
    nodes.endRow();
  }
  folder.writeFile("nodes.csv", nodes.text());
  CsvWriter triangles;
  for (const char* column :
       {"triangle", "a", "b", "c", "strain_mean", "strain_deviator", "strain_shear", "stretch_gauge",
        "curvature_mean [1/m]", "curvature_deviator [1/m]", "curvature_twist [1/m]", "bending_gauge"})
    triangles.add(column);
  triangles.endRow();
  for (std::size_t t = 0; t < sheet->mesh.triangles.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    triangles.add(static_cast<long>(t));
    for (const int node : sheet->mesh.triangles[t]) triangles.add(node);
    for (int i = 0; i < 3; ++i) triangles.add(state.strains.stretch(i, column));
    triangles.add(state.stretchGauge[column]);
    for (int i = 0; i < 3; ++i) triangles.add(state.strains.curvature(i, column));
    triangles.add(state.bendingGauge[column]).endRow();
  }
  folder.writeFile("triangles.csv", triangles.text());
  geometry::SurfaceMesh mesh = sheet->mesh;
  mesh.points = positions;
  geometry::writeMesh(mesh, folder.path("sheet.ply"));
  if (native) writeNative(folder);
  if (isMotion()) writeSteps(folder);
  if (!frames.empty()) writeFrames(folder);
  if (placed) writePlaced(folder);
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
