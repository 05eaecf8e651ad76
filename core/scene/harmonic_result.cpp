#include <algorithm>
#include <complex>
#include <numbers>

#include "core/harmonic/constraint_violation.hpp"
#include "core/scene/harmonic_names.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/second_frequency.hpp"
#include "core/scene/sensitivity_tables.hpp"

namespace pliant::scene {

using harmonic::PointKind;
using harmonic::ResponsePoint;

namespace {

/// What each probe does at one point.
Json probesAt(const HarmonicResult& result, const ResponsePoint& point) {
  Json probes = Json::array();
  const auto& model = result.problem->model();
  for (std::size_t i = 0; i < point.amplitudes.size(); ++i)
    probes.push_back({{"name", model.probes[i].name},
                      {"node", model.probes[i].node},
                      {"path_length", point.amplitudes[i].pathLength},
                      {"maximum_displacement", point.amplitudes[i].maximumDisplacement}});
  return probes;
}

void addSensitivities(const HarmonicResult& result, Json& probes) {
  const auto& model = result.problem->model();
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto gradient = harmonic::pathLengthGradient(*result.problem, result.points.front().z, model.probes[i].node);
    const Eigen::VectorXd derivative = result.sensitivity->derivative().transpose() * gradient;
    Json list = Json::array();
    for (std::size_t p = 0; p < model.parameters.size(); ++p)
      list.push_back({{"parameter", model.parameters[p]->name()},
                      {"path_length_derivative", derivative[static_cast<Eigen::Index>(p)]}});
    probes[i]["sensitivities"] = list;
  }
}

void addStability(const harmonic::Stability& stability, Json& json) {
  json["stability"] = nameOf(stability.state);
  if (stability.state == harmonic::StabilityState::unknown) return;
  json["unstable_multipliers"] = stability.unstableCount;
  Json multipliers = Json::array();
  for (const std::complex<double> multiplier : stability.multipliers)
    multipliers.push_back({multiplier.real(), multiplier.imag()});
  json["multipliers"] = multipliers;
}

void addStrain(const HarmonicResult& result, const ResponsePoint& point, Json& json) {
  if (result.hasTriangles()) json["largest_strain"] = harmonic::largestStrain(*result.problemOf(point), point.z);
}

Json peakEntry(const HarmonicResult& result, const ResponsePoint& point) {
  Json entry;
  addFrequency(entry, point.omega);
  addStrain(result, point, entry);
  if (point.branch > 0) entry["branch"] = point.branch;
  if (point.probe < 0) return entry;
  entry["probe"] = result.problem->model().probes[static_cast<std::size_t>(point.probe)].name;
  const auto& amplitude = point.amplitudes[static_cast<std::size_t>(point.probe)];
  entry["path_length"] = amplitude.pathLength;
  entry["maximum_displacement"] = amplitude.maximumDisplacement;
  return entry;
}

Json bifurcationEntry(const HarmonicResult& result, const ResponsePoint& point) {
  Json entry{{"kind", nameOf(point.kind)}, {"branch", point.branch}};
  addFrequency(entry, point.omega);
  addStrain(result, point, entry);
  entry["probes"] = probesAt(result, point);
  if (const auto critical = harmonic::criticalMultiplier(point); critical != 0.0)
    entry["multiplier"] = {critical.real(), critical.imag()};
  return entry;
}

void addCurve(const HarmonicResult& result, Json& json) {
  Json folds = Json::array(), peaks = Json::array(), bifurcations = Json::array();
  long newtonIterations = 0;
  double residual = 0, correction = 0;
  std::size_t unstable = 0, unknown = 0;
  for (const ResponsePoint& point : result.points) {
    newtonIterations += point.newtonIterations;
    residual = std::max(residual, point.residual);
    correction = std::max(correction, point.correction);
    unstable += point.stability.state == harmonic::StabilityState::unstable;
    unknown += point.stability.state == harmonic::StabilityState::unknown;
    if (point.kind == PointKind::regular) continue;
    if (point.kind == PointKind::peak) {
      peaks.push_back(peakEntry(result, point));
      continue;
    }
    bifurcations.push_back(bifurcationEntry(result, point));
    if (point.kind == PointKind::fold) {
      Json entry;
      addFrequency(entry, point.omega);
      addStrain(result, point, entry);
      entry["probes"] = probesAt(result, point);
      folds.push_back(entry);
    }
  }
  json["point_count"] = result.points.size();
  if (!result.points.empty()) {
    json["first_frequency"] = result.points.front().omega;
    json["last_frequency"] = result.points.back().omega;
  }
  json["peak_count"] = peaks.size();
  if (result.peakSensitivities) addPeakSensitivities(result, peaks);
  json["peaks"] = peaks;
  json["fold_count"] = folds.size();
  json["folds"] = folds;
  json["bifurcation_count"] = bifurcations.size();
  json["bifurcations"] = bifurcations;
  json["unstable_points"] = unstable;
  json["points_of_unknown_stability"] = unknown;
  json["residual"] = residual;
  json["correction"] = correction;
  json["newton_iterations"] = newtonIterations;
}

void addMotion(const HarmonicResult& result, Json& json) {
  if (!result.points.empty()) {
    addFrequency(json, result.points.front().omega);
    Json probes = probesAt(result, result.points.front());
    if (result.sensitivity && result.sensitivity->regular()) addSensitivities(result, probes);
    json["probes"] = probes;
    addStability(result.points.front().stability, json);
    addStrain(result, result.points.front(), json);
  }
  json["residual"] = result.report.residual();
  json["correction"] = result.report.correction();
  Json iterations = Json::array();
  for (const base::IterationRecord& record : result.report.iterations)
    iterations.push_back({{"iteration", record.iteration},
                          {"residual", record.residual},
                          {"step_length", record.stepLength},
                          {"correction", record.correction}});
  json["newton_iterations"] = iterations.empty() ? 0 : iterations.size() - 1;
  json["iterations"] = iterations;
}

void addConstraintViolation(const HarmonicResult& result, Json& json) {
  double largest = -1;
  for (const ResponsePoint& point : result.points)
    if (const auto violations = harmonic::constraintViolations(*result.problemOf(point), point.z);
        violations.size() > 0)
      largest = std::max(largest, violations.maxCoeff());
  if (largest >= 0) json["largest_constraint_violation"] = largest;
}

}  // namespace

std::shared_ptr<const harmonic::HarmonicBalanceProblem> HarmonicResult::problemOf(const ResponsePoint& point) const {
  return point.drivePeriods == problem->drivePeriods() ? problem : subharmonicProblems_.at(point.drivePeriods);
}

void HarmonicResult::addProblemOf(const ResponsePoint& point) {
  if (point.drivePeriods == problem->drivePeriods() || subharmonicProblems_.contains(point.drivePeriods)) return;
  subharmonicProblems_[point.drivePeriods] =
      std::make_shared<const harmonic::HarmonicBalanceProblem>(problem->withDrivePeriods(point.drivePeriods));
}

bool HarmonicResult::hasTriangles() const {
  const auto& parts = problem->model().parts;
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.triangles.empty(); });
}

Json HarmonicResult::summary() const {
  const auto& model = problem->model();
  Json json = summaryHead(*this);
  if (isCurve)
    addCurve(*this, json);
  else
    addMotion(*this, json);
  addConstraintViolation(*this, json);
  json["harmonics"] = problem->basis().order();
  json["samples"] = problem->basis().samplesOfPeriod();
  if (problem->basis().hasTwoFrequencies()) addSecondFrequency(*this, json);
  json["unknowns"] = problem->unknownCount();
  if (leftOut) json["left_out"] = *leftOut;
  if (leftOut || problem->unknownCount() < problem->size())
    json["coordinate_harmonics"] = problem->coordinateHarmonics();
  json["nodes"] = model.nodeCount();
  json["free_coordinates"] = model.dofs.freeCount();
  json["parameters"] = parameterValues(model);
  json["units"] = {{"frequency", "rad/s"},
                   {"frequency_hz", "Hz"},
                   {"path_length", "m"},
                   {"maximum_displacement", "m"},
                   {"largest_strain",
                    "largest principal stretch of any triangle (in its plane) or tetrahedron over a period, minus 1"},
                   {"path_length_derivative", "m per unit of the parameter"},
                   {"frequency_derivative", "rad/s per unit of the parameter"},
                   {"residual", "relative to the driving force"},
                   {"correction", "relative to the swing"},
                   {"left_out", "relative to the longest path"},
                   {"largest_constraint_violation", "relative to the length of the link or bar"},
                   {"seconds", "s"}};
  if (problem->basis().hasTwoFrequencies()) addSecondFrequencyUnits(json["units"]);
  addRunInformation(json, *this);
  return json;
}

}  // namespace pliant::scene
