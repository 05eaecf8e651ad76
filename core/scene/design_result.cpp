#include "core/scene/design_result.hpp"

#include <cmath>
#include <numbers>

#include "core/mechanics/drive_frequency.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/harmonic_names.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

using harmonic::DesignIterate;
using mechanics::Matrix;

namespace {

constexpr std::string_view coordinateLetters = "xyz";

/// A design parameter and its values before and after.
struct DesignedParameter {
  const mechanics::DesignParameter& parameter;
  double minimum, maximum, before, after;
};

std::vector<DesignedParameter> designedParameters(const DesignResult& result) {
  std::vector<DesignedParameter> list;
  const mechanics::Model& model = *result.before().model;
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    const auto& parameter = *model.parameters[static_cast<std::size_t>(result.parameters[i])];
    const auto index = static_cast<Eigen::Index>(i);
    list.push_back({parameter, parameter.minimum(model), parameter.maximum(model), result.before().values[index],
                    result.after().values[index]});
  }
  return list;
}

Json probesOf(const DesignResult& result) {
  Json probes = Json::array();
  const auto& list = result.before().model->probes;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const harmonic::Amplitude &before = result.before().amplitudes[i], &after = result.after().amplitudes[i];
    probes.push_back({{"name", list[i].name},
                      {"node", list[i].node},
                      {"path_length_before", before.pathLength},
                      {"path_length", after.pathLength},
                      {"gain", after.pathLength / before.pathLength},
                      {"maximum_displacement_before", before.maximumDisplacement},
                      {"maximum_displacement", after.maximumDisplacement}});
  }
  return probes;
}

Json pathsOf(const DesignResult& result) {
  Json paths = Json::array();
  const auto before = result.motionOf(result.before()), after = result.motionOf(result.after());
  const auto& probes = result.before().model->probes;
  for (const harmonic::PathGoal& goal : result.paths) {
    const auto first = harmonic::pathDistance(*before->problem, result.before().z, goal);
    const auto last = harmonic::pathDistance(*after->problem, result.after().z, goal);
    Json entry{{"error_before", first.relative},
               {"error", last.relative},
               {"distance_before", first.rootMeanSquare},
               {"distance", last.rootMeanSquare}};
    Json ofProbes = Json::array();
    for (std::size_t i = 0; i < goal.paths.size(); ++i)
      for (const mechanics::Probe& probe : probes)
        if (probe.node == goal.paths[i].node) {
          ofProbes.push_back({{"name", probe.name}, {"error", last.relativeOfPath[i]}});
          break;
        }
    entry["probes"] = ofProbes;
    paths.push_back(entry);
  }
  return paths;
}

Json constraintsOf(const DesignConstraints& constraints) {
  Json list = Json::array();
  const auto &before = constraints.states.front(), &after = constraints.states.back();
  const auto finite = [](double bound) { return std::isfinite(bound) ? Json(bound) : Json(); };
  for (std::size_t i = 0; i < constraints.list.size(); ++i)
    list.push_back({{"name", constraints.list[i].name},
                    {"at_least", finite(constraints.list[i].lower)},
                    {"at_most", finite(constraints.list[i].upper)},
                    {"value_before", before[i].exactValue},
                    {"value", after[i].exactValue},
                    {"smooth_value", after[i].value},
                    {"multiplier", constraints.optimality.multipliers[static_cast<Eigen::Index>(i)]}});
  return list;
}

std::string historyTable(const DesignResult& result) {
  CsvWriter csv;
  csv.add("iteration").add("objective").add("projected gradient").add("step length").add("evaluations").add("solves");
  const auto& model = *result.before().model;
  for (const auto& probe : model.probes) csv.add(probe.name + " path length [m]");
  for (const DesignedParameter& p : designedParameters(result)) {
    const std::string unit = base::siUnit(p.parameter.dimension());
    csv.add(p.parameter.name() + (unit.empty() ? "" : " [" + unit + "]"));
  }
  for (const harmonic::DesignConstraint& constraint : result.constraints.list) csv.add(constraint.name);
  csv.endRow();
  for (const DesignIterate& design : result.design.history) {
    csv.add(design.iteration).add(design.objective).add(design.projectedGradient).add(design.stepLength);
    csv.add(design.evaluations).add(design.solves);
    for (const auto& amplitude : design.amplitudes) csv.add(amplitude.pathLength);
    for (const double value : design.values) csv.add(value);
    if (!result.constraints.list.empty())
      for (const auto& state : result.constraints.states[static_cast<std::size_t>(design.iteration)])
        csv.add(state.exactValue);
    csv.endRow();
  }
  return csv.text();
}

std::string designedParameterTable(const DesignResult& result) {
  CsvWriter csv;
  csv.add("parameter").add("pointer").add("unit").add("minimum").add("maximum").add("before").add("after").endRow();
  for (const DesignedParameter& p : designedParameters(result)) {
    csv.add(p.parameter.name()).add(p.parameter.pointer()).add(base::siUnit(p.parameter.dimension()));
    csv.add(p.minimum).add(p.maximum).add(p.before).add(p.after).endRow();
  }
  return csv.text();
}

/// A column of `designTrajectoryTable` each coordinate.
struct NamedPath {
  std::string name;
  Matrix positions;
};

std::string designTrajectoryTable(const DesignResult& result) {
  const auto before = result.motionOf(result.before()), after = result.motionOf(result.after());
  std::vector<NamedPath> paths;
  for (const auto& probe : result.before().model->probes) {
    paths.push_back({probe.name + " before", before->problem->nodeTrajectory(result.before().z, probe.node)});
    paths.push_back({probe.name + " after", after->problem->nodeTrajectory(result.after().z, probe.node)});
    for (const harmonic::PathGoal& goal : result.paths) {
      const double phase = harmonic::pathDistance(*after->problem, result.after().z, goal).phase;
      for (const harmonic::TargetPath& target : goal.paths) {
        if (target.node != probe.node) continue;
        const int size = static_cast<int>(target.coefficients.rows());
        const math::HarmonicBasis basis(size / 2, std::max(result.samples, size));
        Matrix positions(result.samples, target.coefficients.cols());
        for (int i = 0; i < result.samples; ++i)
          positions.row(i) =
              basis.valuesAt(2 * std::numbers::pi * i / result.samples + phase).transpose() * target.coefficients;
        paths.push_back({probe.name + " target", positions});
      }
    }
  }
  CsvWriter csv;
  csv.add("sample").add("omega t [rad]");
  for (const NamedPath& path : paths)
    for (Eigen::Index axis = 0; axis < path.positions.cols(); ++axis)
      csv.add(path.name + " " + coordinateLetters[static_cast<std::size_t>(axis)] + " [m]");
  csv.endRow();
  for (int sample = 0; sample < result.samples; ++sample) {
    csv.add(sample).add(2 * std::numbers::pi * sample / result.samples);
    for (const NamedPath& path : paths)
      for (const double coordinate : path.positions.row(sample)) csv.add(coordinate);
    csv.endRow();
  }
  return csv.text();
}

}  // namespace

double DesignResult::omegaOf(const DesignIterate& iterate) const {
  return mechanics::driveFrequency(*iterate.model).value_or(omega);
}

std::shared_ptr<HarmonicResult> DesignResult::motionOf(const DesignIterate& iterate) const {
  auto result = std::make_shared<HarmonicResult>();
  result->termination = base::TerminationType::converged;
  result->provenance = provenance;
  result->problem =
      std::make_shared<const harmonic::HarmonicBalanceProblem>(iterate.model, math::HarmonicBasis(harmonics, samples));
  harmonic::ResponsePoint point;
  point.omega = omegaOf(iterate);
  point.z = iterate.z;
  point.amplitudes = iterate.amplitudes;
  result->points.push_back(std::move(point));
  return result;
}

std::vector<std::string> DesignResult::warnings() const {
  if (design.history.empty()) return {};
  std::vector<std::string> sentences = motionOf(after())->warnings();
  if (stability.state == harmonic::StabilityState::unstable)
    sentences.emplace_back(
        "The last design's motion is unstable: small disturbances grow, so the real thing will move otherwise.");
  if (constraints.optimality.violation > harmonic::constraintTolerance)
    sentences.emplace_back("The last design breaks its constraints; no better one was found.");
  return sentences;
}

Json DesignResult::summary() const {
  Json json = summaryHead(*this);
  addFrequency(json, design.history.empty() ? omega : omegaOf(after()));
  json["iterations"] = design.history.empty() ? 0 : after().iteration;
  json["evaluations"] = design.evaluations;
  json["solves"] = design.solves;
  json["failed_designs"] = design.failedDesigns;
  if (!design.history.empty()) {
    json["objective_before"] = before().objective;
    json["objective"] = after().objective;
    json["projected_gradient"] = after().projectedGradient;
    json["stability"] = nameOf(stability.state);
    json["probes"] = probesOf(*this);
    if (!paths.empty()) json["paths"] = pathsOf(*this);
    if (!starts.empty()) {
      Json list = Json::array();
      for (const harmonic::DesignStart& start : starts)
        list.push_back({{"objective_before", start.objective},
                        {"objective", start.reached},
                        {"constraint_violation", start.violation},
                        {"designs", start.designs},
                        {"termination", base::toString(start.termination)}});
      json["starts"] = list;
      json["best_start"] = bestStart;
    }
    if (!constraints.list.empty()) {
      json["constraints"] = constraintsOf(constraints);
      json["constraint_violation"] = constraints.optimality.violation;
      json["optimality_residual"] = constraints.optimality.stationarity;
    }
    Json list = Json::array();
    for (const DesignedParameter& p : designedParameters(*this))
      list.push_back({{"name", p.parameter.name()},
                      {"pointer", p.parameter.pointer()},
                      {"before", p.before},
                      {"value", p.after},
                      {"unit", base::siUnit(p.parameter.dimension())}});
    json["parameter_count"] = list.size();
    json["parameters"] = list;
    json["nodes"] = before().model->nodeCount();
    json["free_coordinates"] = before().model->dofs.freeCount();
  }
  json["harmonics"] = harmonics;
  json["samples"] = samples;
  json["units"] = {{"frequency", "rad/s"},
                   {"frequency_hz", "Hz"},
                   {"path_length", "m"},
                   {"maximum_displacement", "m"},
                   {"gain", "path length after over before"},
                   {"error", "root mean square distance from the target path over the target's from its middle"},
                   {"distance", "root mean square distance from the target path, m"},
                   {"projected_gradient", "objective per range of a parameter"},
                   {"constraint_violation", "largest, over the bound"},
                   {"optimality_residual", "what no multipliers balance of the objective's gradient, over its largest"},
                   {"multiplier", "fall of the objective per unit of the bound"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void DesignResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  if (!design.history.empty()) {
    folder.writeFile("history.csv", historyTable(*this));
    folder.writeFile("parameters.csv", designedParameterTable(*this));
    folder.writeFile("trajectories.csv", designTrajectoryTable(*this));
  }
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
