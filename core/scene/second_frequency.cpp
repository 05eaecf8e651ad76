#include "core/scene/second_frequency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/harmonic/path_length.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using harmonic::HarmonicBalanceProblem;
using harmonic::ResponsePoint;

namespace {

constexpr std::size_t combinationsShown = 12;
constexpr int mostPeriodsInFile = 1 << 16;  ///< a larger number is damage

bool driveHasSecondFrequency(const Scene& scene) {
  const auto isSecond = [](const Json& term) { return term.value("of", "") == "second_frequency"; };
  for (const char* list : {"drives", "loads"})
    for (const Json& entry : scene.normalized()[list])
      if (const Json terms = entry.value("harmonics", Json::array()); std::any_of(terms.begin(), terms.end(), isSecond))
        return true;
  return false;
}

/// Types of studies for which drives and loads swing.
bool isOfDrivenMotion(const std::string& type) {
  constexpr std::array<std::string_view, 10> types{
      "periodic_motion", "frequency_response", "backbone",        "calibration",      "design",
      "design_space",    "linear_modes",       "linear_response", "time_integration", "comparison"};
  return std::find(types.begin(), types.end(), type) != types.end();
}

/// How far each pair of sine and cosine moves a node [m].
std::vector<double> combinationAmplitudes(const HarmonicBalanceProblem& problem, const mechanics::Vector& z, int node) {
  const mechanics::Matrix coefficients = harmonic::nodeCoefficients(problem, z, node);
  std::vector<double> amplitudes;
  for (int k = 1; k <= problem.basis().harmonics(); ++k)
    amplitudes.push_back(coefficients.middleRows(2 * k - 1, 2).norm());
  return amplitudes;
}

double multipleOfFirst(const math::HarmonicBasis& basis, int k) { return basis.rate(k) / basis.periods(); }

Json strongestCombinations(const HarmonicResult& result, const ResponsePoint& point, int node) {
  const math::HarmonicBasis& basis = result.problem->basis();
  const std::vector<double> amplitudes = combinationAmplitudes(*result.problem, point.z, node);
  std::vector<int> order;
  for (int k = 1; k <= basis.harmonics(); ++k) order.push_back(k);
  const auto amplitude = [&](int k) { return amplitudes[static_cast<std::size_t>(k) - 1]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return amplitude(a) > amplitude(b); });
  order.resize(std::min(order.size(), combinationsShown));
  Json list = Json::array();
  for (const int k : order) {
    const auto [first, second] = basis.combination(k);
    list.push_back({{"k1", first},
                    {"k2", second},
                    {"frequency", std::abs(multipleOfFirst(basis, k)) * point.omega},
                    {"amplitude", amplitude(k)}});
  }
  return list;
}

}  // namespace

bool hasSecondFrequency(const Json& options) {
  return options.contains("second_frequency") || options.contains("frequency_ratio");
}

math::HarmonicBasis basisOf(const Json& options) {
  const int harmonics = options["harmonics"], samples = options["samples"];
  if (!hasSecondFrequency(options)) return {harmonics, samples};
  const double ratio = options.contains("frequency_ratio")
                           ? options["frequency_ratio"].get<double>()
                           : options["second_frequency"].get<double>() / options["frequency"].get<double>();
  return math::HarmonicBasis::ofTwoFrequencies(harmonics, samples, ratio);
}

math::HarmonicBasis basisOfResult(const Json& summary) {
  const int harmonics = summary.at("harmonics"), samples = summary.at("samples");
  if (!summary.contains("frequency_ratio")) return {harmonics, samples};
  const int periods = summary.at("span_periods");
  if (periods < 1 || periods > mostPeriodsInFile) throw std::invalid_argument("an impossible number of periods");
  return math::HarmonicBasis::ofTwoFrequencies(harmonics, samples, summary.at("frequency_ratio"), periods);
}

void checkSecondFrequency(const Scene& scene, const Json& options) {
  const std::string type = options["type"];
  const auto names = studyNames(scene);
  const auto index = std::find(names.begin(), names.end(), options["name"].get<std::string>()) - names.begin();
  const std::string place = scene.name() + ": " + childPointer("/studies", static_cast<std::size_t>(index));
  if (!hasSecondFrequency(options)) {
    if (!isOfDrivenMotion(type) || !driveHasSecondFrequency(scene)) return;
    const std::string reason = "A drive or load has a term of the second frequency, ";
    if (type == "periodic_motion") throw InputError(place, reason + "so this study needs \"second_frequency\".");
    if (type == "frequency_response") throw InputError(place, reason + "so this study needs \"frequency_ratio\".");
    throw InputError(place + "/type", reason + "which studies of the type " + quote(type) +
                                          " do not know; periodic_motion and frequency_response do.");
  }
  const auto refuse = [&](const char* key, const std::string& why) { throw InputError(place + "/" + key, why); };
  if (options.contains("harmonics_tolerance"))
    refuse(
        "harmonics_tolerance",
        "Harmonics are not adapted with two driving frequencies; leave this key out and compare with more harmonics.");
  if (options.value("branches", 0) > 0)
    refuse("branches", "Motions with two driving frequencies have no period, so no branches are followed.");
  if (options.value("peak_sensitivity", false))
    refuse("peak_sensitivity", "Sensitivities of peaks are not known with two driving frequencies.");
}

void addSecondFrequency(const HarmonicResult& result, Json& json) {
  const math::HarmonicBasis& basis = result.problem->basis();
  json["frequency_ratio"] = basis.ratio();
  json["span_periods"] = basis.periods();
  json["combinations"] = basis.harmonics();
  if (result.isCurve || result.points.empty()) return;
  const ResponsePoint& point = result.points.front();
  json["second_frequency"] = basis.ratio() * point.omega;
  json["second_frequency_hz"] = basis.ratio() * point.omega / (2 * std::numbers::pi);
  const auto& probes = result.problem->model().probes;
  for (std::size_t i = 0; i < probes.size(); ++i)
    json["probes"][i]["combinations"] = strongestCombinations(result, point, probes[i].node);
}

void addSecondFrequencyUnits(Json& units) {
  units["path_length"] = "m, mean over periods of the first frequency";
  units["maximum_displacement"] = "m, at any time";
  units["largest_strain"] =
      "largest principal stretch of any triangle (in its plane) or tetrahedron at the samples of the torus, minus 1";
  units["amplitude"] = "m, of the terms with the frequency k1 times the first plus k2 times the second";
  units["span_periods"] = "periods of the first frequency that trajectories and animations run over";
}

std::string combinationTable(const HarmonicResult& result) {
  const math::HarmonicBasis& basis = result.problem->basis();
  const auto& probes = result.problem->model().probes;
  CsvWriter csv;
  csv.add("point").add("k1").add("k2").add("omega [rad/s]");
  for (const auto& probe : probes) csv.add(probe.name + " amplitude [m]");
  csv.endRow();
  int index = 0;
  for (const ResponsePoint& point : result.points) {
    std::vector<std::vector<double>> amplitudes;
    for (const auto& probe : probes) amplitudes.push_back(combinationAmplitudes(*result.problem, point.z, probe.node));
    for (int k = 1; k <= basis.harmonics(); ++k) {
      const auto [first, second] = basis.combination(k);
      csv.add(index).add(first).add(second).add(std::abs(multipleOfFirst(basis, k)) * point.omega);
      for (const auto& ofProbe : amplitudes) csv.add(ofProbe[static_cast<std::size_t>(k) - 1]);
      csv.endRow();
    }
    ++index;
  }
  return csv.text();
}

void addTimeSeries(const HarmonicResult& result, const ResponsePoint& point, int index, CsvWriter& csv) {
  constexpr int instants = 64;  // of a period
  const auto problem = result.problemOf(point);
  const int count = instants * (result.isCurve ? 1 : problem->drivePeriods());
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / instants;
    const mechanics::Vector positions = problem->configurationAt(point.z, angle / problem->drivePeriods());
    csv.add(index).add(i).add(angle);
    for (const auto& probe : problem->model().probes)
      for (int axis = 0; axis < problem->model().dimension; ++axis)
        csv.add(positions[probe.node * problem->model().dimension + axis]);
    csv.endRow();
  }
}

std::vector<std::string> secondFrequencyWarnings(const HarmonicBalanceProblem& problem) {
  constexpr double asGoodAsWhole = 1e-6;  // relative
  std::vector<std::string> sentences;
  const math::HarmonicBasis& basis = problem.basis();
  if (!basis.hasTwoFrequencies()) return sentences;
  if (!problem.model().hasSecondFrequency())
    sentences.emplace_back("No drive or load has a term of the second frequency: without it the motion is the same.");
  for (int first = 1; first < 2 * basis.order(); ++first) {
    const double second = std::round(basis.ratio() * first);
    if (second < 1 || first + second > 2 * basis.order() ||
        std::abs(basis.ratio() * first - second) > asGoodAsWhole * second)
      continue;
    sentences.push_back("The frequencies are as " + std::to_string(first) + " to " +
                        std::to_string(static_cast<int>(second)) +
                        ": drives with these orders of one frequency have the same motion with fewer coefficients.");
    break;
  }
  return sentences;
}

}  // namespace pliant::scene
