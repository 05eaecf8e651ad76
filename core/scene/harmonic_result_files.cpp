#include <algorithm>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/harmonic/backbone.hpp"
#include "core/harmonic/constraint_violation.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/harmonic_names.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/second_frequency.hpp"
#include "core/scene/sensitivity_tables.hpp"

namespace pliant::scene {

using base::InputError;
using harmonic::ResponsePoint;
using mechanics::Model;

namespace {

constexpr std::string_view axisNames = "xyz";
constexpr std::size_t columnsBeforeProbes = 13;  ///< of response.csv
constexpr std::size_t columnsBeforeCoefficients = 3;
constexpr int mostDrivePeriods = 1 << 16;  ///< a larger number in a file is damage

std::string responseTable(const HarmonicResult& result) {
  const Model& model = result.problem->model();
  CsvWriter csv;
  csv.add("point")
      .add("kind")
      .add("peak of")
      .add("branch")
      .add("drive periods")
      .add("omega [rad/s]")
      .add("arc length")
      .add("residual")
      .add("correction");
  csv.add("stability")
      .add("unstable multipliers")
      .add("critical multiplier (real)")
      .add("critical multiplier (imaginary)");
  for (const auto& probe : model.probes)
    csv.add(probe.name + " path length [m]").add(probe.name + " maximum displacement [m]");
  csv.add("newton iterations");
  if (result.hasTriangles()) csv.add("largest strain");
  csv.endRow();
  int index = 0;
  for (const ResponsePoint& point : result.points) {
    csv.add(index++).add(nameOf(point.kind));
    csv.add(point.probe < 0 ? std::string_view() : model.probes[static_cast<std::size_t>(point.probe)].name);
    csv.add(point.branch).add(point.drivePeriods);
    csv.add(point.omega).add(point.arcLength).add(point.residual).add(point.correction);
    csv.add(nameOf(point.stability.state)).add(point.stability.unstableCount);
    const std::complex<double> critical = harmonic::criticalMultiplier(point);
    csv.add(critical.real()).add(critical.imag());
    for (const auto& amplitude : point.amplitudes) csv.add(amplitude.pathLength).add(amplitude.maximumDisplacement);
    csv.add(point.newtonIterations);
    if (result.hasTriangles()) csv.add(harmonic::largestStrain(*result.problemOf(point), point.z));
    csv.endRow();
  }
  return csv.text();
}

/// "2" of one frequency, "2 -1" of two.
std::string combinationName(const math::HarmonicBasis& basis, int k) {
  if (!basis.hasTwoFrequencies()) return std::to_string(k);
  const auto [first, second] = basis.combination(k);
  return std::to_string(first) + " " + std::to_string(second);
}

std::string coefficientTable(const HarmonicResult& result) {
  const Model& model = result.problem->model();
  int harmonics = result.problem->basis().harmonics();
  for (const ResponsePoint& point : result.points)
    harmonics = std::max(harmonics, result.problemOf(point)->basis().harmonics());
  CsvWriter csv;
  csv.add("point").add("node").add("axis").add("constant [m]");
  for (int k = 1; k <= harmonics; ++k)
    for (const char* function : {"sin ", "cos "})
      csv.add(function + combinationName(result.problem->basis(), k) + " [m]");
  csv.endRow();
  int index = 0;
  for (const ResponsePoint& point : result.points) {
    const int count = result.problemOf(point)->basis().size();
    for (int free = 0; free < model.dofs.freeCount(); ++free) {
      const int coordinate = model.dofs.freeCoordinates[static_cast<std::size_t>(free)];
      csv.add(index).add(coordinate / model.dimension);
      csv.add(axisNames.substr(static_cast<std::size_t>(coordinate % model.dimension), 1));
      for (int i = 0; i < count; ++i) csv.add(point.z[free * count + i]);
      for (int i = count; i <= 2 * harmonics; ++i) csv.add(0.0);
      csv.endRow();
    }
    ++index;
  }
  return csv.text();
}

std::string trajectoryTable(const HarmonicResult& result) {
  const Model& model = result.problem->model();
  CsvWriter csv;
  csv.add("point").add("sample").add("omega t [rad]");
  for (const auto& probe : model.probes)
    for (int axis = 0; axis < model.dimension; ++axis)
      csv.add(probe.name + " " + axisNames[static_cast<std::size_t>(axis)] + " [m]");
  csv.endRow();
  int index = 0;
  for (const ResponsePoint& point : result.points) {
    std::vector<mechanics::Matrix> paths;
    const auto problem = result.problemOf(point);
    const int samples = problem->basis().samples();
    for (const auto& probe : model.probes) paths.push_back(problem->nodeTrajectory(point.z, probe.node));
    // Samples of two phases follow no line of time.
    if (problem->basis().hasTwoFrequencies()) {
      addTimeSeries(result, point, index++, csv);
      continue;
    }
    for (int sample = 0; sample < samples; ++sample) {
      csv.add(index).add(sample).add(2 * std::numbers::pi * point.drivePeriods * sample / samples);
      for (const auto& path : paths)
        for (int axis = 0; axis < model.dimension; ++axis) csv.add(path(sample, axis));
      csv.endRow();
    }
    ++index;
  }
  return csv.text();
}

/// Empty where there are no rigid constraints, and of two frequencies, whose samples follow no line of time.
std::string constraintTable(const HarmonicResult& result) {
  CsvWriter csv;
  csv.add("point").add("sample").add("omega t [rad]").add("constraint violation").endRow();
  int index = 0;
  for (const ResponsePoint& point : result.points) {
    const auto problem = result.problemOf(point);
    const mechanics::Vector violations = harmonic::constraintViolations(*problem, point.z);
    if (violations.size() == 0 || problem->basis().hasTwoFrequencies()) return {};
    const int samples = problem->basis().samples();
    for (int sample = 0; sample < samples; ++sample)
      csv.add(index)
          .add(sample)
          .add(2 * std::numbers::pi * point.drivePeriods * sample / samples)
          .add(violations[sample])
          .endRow();
    ++index;
  }
  return csv.text();
}

[[noreturn]] void otherScene() {
  throw InputError("", "This result belongs to a scene with other nodes, probes, drives or locked coordinates.");
}

/// The model of the scene with the parameter values that the result was computed with.
std::shared_ptr<const Model> modelOf(const Scene& scene, const Json& summary) {
  const Json& values = summary.at("parameters");
  auto model = mechanics::withoutDriveFrequencies(buildModel(scene), [&](const std::string& pointer) {
    return std::any_of(values.begin(), values.end(), [&](const Json& value) { return value.at("pointer") == pointer; });
  });
  if (values.size() != model->parameters.size()) otherScene();
  for (std::size_t p = 0; p < values.size(); ++p) {
    const double value = values[p].at("value");
    if (value != model->parameters[p]->value(*model))
      model = std::make_shared<const Model>(model->parameters[p]->withValue(*model, value));
  }
  return model;
}

void readPoints(HarmonicResult& result, const std::string& response, const std::string& coefficients) {
  const Model& model = result.problem->model();
  const auto rows = readCsv(response), values = readCsv(coefficients);
  const auto freeCount = static_cast<std::size_t>(model.dofs.freeCount());
  const std::size_t probeCount = model.probes.size();
  if (values.size() != rows.size() * freeCount) otherScene();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const std::size_t iterationsColumn = columnsBeforeProbes + 2 * probeCount;
    if (row.size() != iterationsColumn + 1 + (result.hasTriangles() ? 1 : 0)) otherScene();
    ResponsePoint point;
    point.kind = pointKindOf(row[1]);
    for (std::size_t p = 0; p < probeCount; ++p)
      if (row[2] == model.probes[p].name) point.probe = static_cast<int>(p);
    point.branch = csvInteger(row[3]);
    point.drivePeriods = csvInteger(row[4]);
    if (point.drivePeriods < 1 || point.drivePeriods > mostDrivePeriods) otherScene();
    if (result.problem->basis().hasTwoFrequencies() && point.drivePeriods != result.problem->drivePeriods())
      otherScene();
    result.addProblemOf(point);
    const auto count = static_cast<std::size_t>(result.problemOf(point)->basis().size());
    point.omega = csvNumber(row[5]);
    point.arcLength = csvNumber(row[6]);
    point.residual = csvNumber(row[7]);
    point.correction = csvNumber(row[8]);
    point.stability.state = stabilityStateOf(row[9]);
    point.stability.unstableCount = csvInteger(row[10]);
    if (const std::complex critical(csvNumber(row[11]), csvNumber(row[12])); critical != 0.0)
      point.stability.multipliers.push_back(critical);
    for (std::size_t p = 0; p < probeCount; ++p)
      point.amplitudes.push_back(
          {csvNumber(row[columnsBeforeProbes + 2 * p]), csvNumber(row[columnsBeforeProbes + 2 * p + 1])});
    point.newtonIterations = csvInteger(row[iterationsColumn]);
    point.z.resize(static_cast<Eigen::Index>(count * freeCount));
    for (std::size_t free = 0; free < freeCount; ++free) {
      const auto& cells = values[i * freeCount + free];
      const int coordinate = model.dofs.freeCoordinates[free];
      if (cells.size() < columnsBeforeCoefficients + count || csvInteger(cells[1]) != coordinate / model.dimension ||
          cells[2] != axisNames.substr(static_cast<std::size_t>(coordinate % model.dimension), 1))
        otherScene();
      for (std::size_t c = 0; c < count; ++c)
        point.z[static_cast<Eigen::Index>(free * count + c)] = csvNumber(cells[columnsBeforeCoefficients + c]);
    }
    result.points.push_back(std::move(point));
  }
}

base::TerminationType terminationOf(const std::string& text) {
  using enum base::TerminationType;
  for (const auto termination : {converged, iterationLimit, infeasible, cancelled})
    if (text == base::toString(termination)) return termination;
  return failed;
}

void readSummary(HarmonicResult& result, const Json& summary) {
  result.isLinear = summary.at("type") == "linear_response";
  result.isBackbone = summary.at("type") == "backbone";
  result.isCurve = result.isLinear || result.isBackbone || summary.at("type") == "frequency_response";
  result.termination = terminationOf(summary.at("termination"));
  result.message = summary.at("message");
  result.seconds = summary.at("seconds");
  const Json& provenance = summary.at("provenance");
  result.provenance = {provenance.at("version"), provenance.at("scene"), provenance.at("scene_hash"),
                       summary.at("study"), provenance.at("options")};
  if (summary.contains("left_out")) result.leftOut = summary.at("left_out").get<double>();
  result.report.termination = result.termination;
  result.report.message = result.message;
  result.report.seconds = result.seconds;
  if (result.isCurve) return;
  for (const Json& record : summary.at("iterations"))
    result.report.iterations.push_back(
        {record.at("iteration"), record.at("residual"), record.at("step_length"), record.at("correction")});
}

}  // namespace

void HarmonicResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  folder.writeFile("response.csv", responseTable(*this));
  folder.writeFile("coefficients.csv", coefficientTable(*this));
  folder.writeFile("trajectories.csv", trajectoryTable(*this));
  if (problem->basis().hasTwoFrequencies()) folder.writeFile("combinations.csv", combinationTable(*this));
  if (const std::string violations = constraintTable(*this); !violations.empty())
    folder.writeFile("constraint_violation.csv", violations);
  if (sensitivity && sensitivity->regular()) folder.writeFile("sensitivity.csv", sensitivityTable(*this));
  if (peakSensitivities) folder.writeFile("peak_sensitivity.csv", peakSensitivityTable(*this));
  if (const geometry::SurfaceMesh mesh = surfaceAt(problem->model(), problem->model().restPositions);
      !mesh.triangles.empty())
    geometry::writeMesh(mesh, folder.path("mesh.ply"));
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

std::shared_ptr<HarmonicResult> HarmonicResult::read(const Scene& scene, const std::filesystem::path& directory) {
  auto result = std::make_shared<HarmonicResult>();
  const std::string text = readTextFile(directory / "summary.json");
  locate((directory / "summary.json").string(), [&] {
    try {
      const Json summary = parseJson(text);
      if (summary.at("kind") != result->kind())
        throw InputError(
            "", "This result has no periodic motions: it is of the kind " + summary.at("kind").dump() + ".");
      const math::HarmonicBasis basis = basisOfResult(summary);
      readSummary(*result, summary);
      harmonic::HarmonicBalanceProblem problem(
          modelOf(scene, summary), basis, 1, summary.value("coordinate_harmonics", std::vector<int>{}));
      result->problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(
          result->isBackbone ? harmonic::freeProblem(problem) : std::move(problem));
    } catch (const Json::exception&) {
      throw InputError("", "This is no summary of a result, or it is damaged.");
    } catch (const std::invalid_argument&) {
      throw InputError("", "This summary has impossible numbers of harmonics and samples.");
    }
  });
  locate(directory.string(), [&] {
    readPoints(*result, readTextFile(directory / "response.csv"), readTextFile(directory / "coefficients.csv"));
    if (const auto table = directory / "peak_sensitivity.csv"; std::filesystem::exists(table))
      result->peakSensitivities = readPeakSensitivities(*result, readTextFile(table));
  });
  if (!result->isCurve && result->termination == base::TerminationType::converged && !result->points.empty()) {
    harmonic::PeriodicMotion motion;
    motion.omega = result->points.front().omega;
    motion.z = result->points.front().z;
    result->sensitivity = std::make_shared<const harmonic::ResponseSensitivity>(*result->problem, motion);
  }
  return result;
}

}  // namespace pliant::scene
