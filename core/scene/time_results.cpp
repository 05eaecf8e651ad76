#include "core/scene/time_results.hpp"

#include <algorithm>
#include <complex>
#include <numbers>

#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

using harmonic::ComparedSolution;
using mechanics::Matrix;

namespace {

std::string timeTrajectories(const TimeResult& result) {
  const mechanics::Model& model = *result.model;
  const Matrix& positions = result.integration.positions;
  CsvWriter csv;
  csv.add("step").add("omega t [rad]");
  for (const auto& probe : model.probes)
    for (int axis = 0; axis < model.dimension; ++axis) csv.add(probe.name + " " + "xyz"[axis] + " [m]");
  csv.endRow();
  for (Eigen::Index step = 0; step < positions.rows(); ++step) {
    csv.add(static_cast<long>(step));
    csv.add(2 * std::numbers::pi * static_cast<double>(step) / static_cast<double>(positions.rows()));
    for (const auto& probe : model.probes)
      for (int axis = 0; axis < model.dimension; ++axis) csv.add(positions(step, probe.node * model.dimension + axis));
    csv.endRow();
  }
  return csv.text();
}

std::string periodTable(const harmonic::TimeIntegration& integration) {
  CsvWriter csv;
  csv.add("period").add("e_p [m]").add("e_p per step over swing").add("extrapolated").endRow();
  int period = 0;
  for (const harmonic::PeriodRecord& record : integration.periods) {
    const double residual = integration.report.iterations[static_cast<std::size_t>(period)].residual;
    csv.add(++period).add(record.difference).add(residual).add(record.extrapolated ? 1 : 0).endRow();
  }
  return csv.text();
}

/// Path length (of the polygon through the steps) and largest distance from the mean place, of a node.
Json probeInTime(const mechanics::Model& model, const Matrix& positions, const mechanics::Probe& probe) {
  const Matrix path = positions.middleCols(probe.node * model.dimension, model.dimension);
  double length = 0;
  for (Eigen::Index i = 0; i < path.rows(); ++i) length += (path.row((i + 1) % path.rows()) - path.row(i)).norm();
  const Eigen::RowVectorXd mean = path.colwise().mean();
  return {{"name", probe.name},
          {"node", probe.node},
          {"path_length", length},
          {"maximum_displacement", (path.rowwise() - mean).rowwise().norm().maxCoeff()}};
}

/// Whether there are a solution and a reference to compare it with.
bool isCompared(const ComparedSolution& solution, double swing) {
  return swing > 0 && solution.termination == base::TerminationType::converged;
}

Json solutionJson(const ComparedSolution& solution, double swing) {
  Json json;
  if (solution.harmonics > 0) json["harmonics"] = solution.harmonics;
  json[solution.harmonics > 0 ? "samples" : "steps"] = solution.samples;
  if (isCompared(solution, swing)) {
    json["difference_to_newmark"] = solution.toNewmark;
    json["difference_to_reference"] = solution.toReference;
    json["relative_difference_to_newmark"] = solution.toNewmark / swing;
    json["relative_difference_to_reference"] = solution.toReference / swing;
  }
  if (solution.harmonics == 0) json["periods"] = solution.periods;
  json["termination"] = base::toString(solution.termination);
  json["seconds"] = solution.seconds;
  return json;
}

template <class Belongs>
std::string comparisonTable(const ComparisonResult& result, const Belongs& belongs) {
  CsvWriter csv;
  csv.add("harmonics").add("samples or steps").add("difference to newmark [m]").add("difference to reference [m]");
  csv.add("difference to newmark over swing").add("difference to reference over swing").add("periods");
  csv.add("seconds [s]").endRow();
  const double swing = result.comparison.swing;
  for (const ComparedSolution& solution : result.comparison.solutions) {
    if (!belongs(solution)) continue;
    csv.add(solution.harmonics).add(solution.samples);
    for (const double unit : {1.0, swing})
      for (const double difference : {solution.toNewmark, solution.toReference})
        isCompared(solution, swing) ? csv.add(difference / unit) : csv.add("");
    csv.add(solution.periods).add(solution.seconds).endRow();
  }
  return csv.text();
}

bool isOfHarmonics(const ComparedSolution& solution) { return solution.harmonics > 0 && !solution.sameSamples; }
bool isNewmark(const ComparedSolution& solution) { return solution.harmonics == 0; }
bool hasSameSamples(const ComparedSolution& solution) { return solution.sameSamples; }

}  // namespace

Json TimeResult::summary() const {
  Json json = summaryHead(*this);
  addFrequency(json, integration.omega);
  json["steps_per_period"] = integration.steps;
  json["period_count"] = integration.periods.size();
  json["difference"] = integration.difference();
  json["swing"] = integration.swing;
  json["residual"] = integration.report.residual();
  Json probes = Json::array();
  if (integration.positions.size() > 0)
    for (const mechanics::Probe& probe : model->probes)
      probes.push_back(probeInTime(*model, integration.positions, probe));
  json["probes"] = probes;
  if (!integration.multipliers.empty()) {
    Json multipliers = Json::array();
    for (const auto& multiplier : integration.multipliers)
      multipliers.push_back({multiplier.real(), multiplier.imag()});
    json["multipliers"] = multipliers;
    json["unstable_multipliers"] = std::count_if(integration.multipliers.begin(), integration.multipliers.end(),
                                                 [](const auto& multiplier) { return std::abs(multiplier) > 1; });
  }
  json["newton_iterations"] = integration.newtonIterations;
  json["factorizations"] = integration.factorizations;
  json["nodes"] = model->nodeCount();
  json["free_coordinates"] = model->dofs.freeCount();
  json["parameters"] = parameterValues(*model);
  json["units"] = {{"frequency", "rad/s"},
                   {"frequency_hz", "Hz"},
                   {"difference", "m, e_p of (2.5.1) between the last two periods"},
                   {"swing", "m, root of the mean squared distance of all coordinates from their mean"},
                   {"residual", "e_p per step over the swing"},
                   {"path_length", "m"},
                   {"maximum_displacement", "m"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void TimeResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("trajectories.csv", timeTrajectories(*this));
  folder.writeFile("periods.csv", periodTable(integration));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

Json ComparisonResult::summary() const {
  Json json = summaryHead(*this);
  addFrequency(json, omega);
  json["swing"] = comparison.swing;
  Json harmonics = Json::array(), steps = Json::array(), samples = Json::array();
  for (const ComparedSolution& solution : comparison.solutions)
    (isNewmark(solution)        ? steps
     : hasSameSamples(solution) ? samples
                                : harmonics)
        .push_back(solutionJson(solution, comparison.swing));
  json["harmonics"] = harmonics;
  json["steps"] = steps;
  json["samples"] = samples;
  json["units"] = {{"frequency", "rad/s"},
                   {"frequency_hz", "Hz"},
                   {"swing", "m, root of the mean squared distance of all coordinates from their mean"},
                   {"difference_to_newmark", "m, mean over a period of the distance of all coordinates"},
                   {"difference_to_reference", "m, from the extrapolated integrations"},
                   {"relative_difference_to_newmark", "over the swing"},
                   {"relative_difference_to_reference", "over the swing"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void ComparisonResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("harmonics.csv", comparisonTable(*this, isOfHarmonics));
  folder.writeFile("steps.csv", comparisonTable(*this, isNewmark));
  folder.writeFile("samples.csv", comparisonTable(*this, hasSameSamples));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
