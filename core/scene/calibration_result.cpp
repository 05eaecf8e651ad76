#include "core/scene/calibration_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/mechanics/design_parameter.hpp"
#include "core/scene/calibration_tables.hpp"
#include "core/scene/harmonic_names.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

using harmonic::CalibratedMotion;

namespace {

/// Noise as strong as this between successive residuals makes intervals at least a fifth too narrow.
constexpr double strongSerialCorrelation = 0.2;
/// In standard deviations of what noise alone gives.
constexpr double surelyCorrelated = 4;

Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json fittedParameters(const CalibrationStudyResult& result) {
  Json list = Json::array();
  const auto& uncertainty = result.calibration.uncertainty;
  for (std::size_t i = 0; i < result.calibration.before->parameters.size(); ++i) {
    const auto& parameter = *result.calibration.before->parameters[i];
    const auto index = static_cast<Eigen::Index>(i);
    const double value = result.calibration.history.back().values[index];
    const double halfWidth = uncertainty.halfWidths[index];
    const int bound = result.calibration.atBound[i];
    list.push_back({{"name", parameter.name()},
                    {"pointer", parameter.pointer()},
                    {"before", result.calibration.history.front().values[index]},
                    {"value", value},
                    {"unit", base::siUnit(parameter.dimension())},
                    {"standard_error", numberOrNull(uncertainty.standardErrors[index])},
                    {"lower", numberOrNull(value - halfWidth)},
                    {"upper", numberOrNull(value + halfWidth)},
                    {"at_bound", bound == 0 ? Json() : Json(bound < 0 ? "minimum" : "maximum")}});
  }
  return list;
}

Json fittedMotions(const CalibrationStudyResult& result) {
  Json list = Json::array();
  for (std::size_t i = 0; i < result.calibration.motions.size(); ++i) {
    const CalibratedMotion& motion = result.calibration.motions[i];
    const auto count = static_cast<double>(motion.before.residuals.size());
    Json entry{{"file", result.files[i]}};
    addFrequency(entry, result.measured[i].omega);
    entry["values"] = motion.before.residuals.size();
    entry["time_offset"] = motion.timeOffset;
    entry["root_mean_square_before"] = std::sqrt(motion.before.residuals.squaredNorm() / count);
    entry["root_mean_square"] = motion.rootMeanSquare;
    entry["error"] = numberOrNull(motion.rootMeanSquare / motion.swing);
    entry["serial_correlation"] = motion.serialCorrelation;
    if (!result.stabilities.empty()) entry["stability"] = nameOf(result.stabilities[i].state);
    list.push_back(entry);
  }
  return list;
}

/// The largest correlation of two parameters, by absolute value.
double largestCorrelation(const mechanics::Matrix& correlation) {
  double largest = 0;
  for (Eigen::Index i = 0; i < correlation.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (std::isfinite(correlation(i, j))) largest = std::max(largest, std::abs(correlation(i, j)));
  return largest;
}

}  // namespace

std::vector<std::string> CalibrationStudyResult::undeterminedSentences() const {
  constexpr double smallShare = 1e-3;
  std::vector<std::string> sentences;
  if (calibration.history.empty()) return sentences;
  const auto& parameters = calibration.before->parameters;
  const mechanics::Matrix& undetermined = calibration.uncertainty.undetermined;
  for (Eigen::Index c = 0; c < undetermined.cols(); ++c) {
    mechanics::Vector shares = undetermined.col(c);  // of the ranges
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
      const auto& parameter = *parameters[static_cast<std::size_t>(i)];
      shares[i] /= parameter.maximum(*calibration.before) - parameter.minimum(*calibration.before);
    }
    const double largest = shares.cwiseAbs().maxCoeff();
    std::string names, changes;
    int count = 0;
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
      if (!(std::abs(shares[i]) > smallShare * largest)) continue;
      const auto& parameter = *parameters[static_cast<std::size_t>(i)];
      // A change that is a hundredth of a range at most.
      const double change = 0.01 * undetermined(i, c) / largest;
      names += (count == 0 ? "" : ", ") + quote(parameter.name());
      changes += (count == 0 ? "" : ", ") + quote(parameter.name()) + " by " +
                 base::formatQuantity(change, parameter.dimension());
      ++count;
    }
    sentences.push_back(count == 1 ? "The measured motions do not determine the parameter " + names + "."
                                   : "The parameters " + names +
                                         " cannot be told apart: the measured motions stay the same if they change "
                                         "together, " +
                                         changes + ".");
  }
  return sentences;
}

std::vector<std::string> CalibrationStudyResult::warnings() const {
  std::vector<std::string> sentences = undeterminedSentences();
  for (std::size_t i = 0; i < calibration.atBound.size(); ++i)
    if (calibration.atBound[i] != 0)
      sentences.push_back("The parameter " + quote(calibration.before->parameters[i]->name()) + " stands at its " +
                          (calibration.atBound[i] < 0 ? "minimum" : "maximum") +
                          ", so it has no interval, and those of the others hold for it there.");
  for (std::size_t i = 0; i < calibration.motions.size(); ++i) {
    const CalibratedMotion& motion = calibration.motions[i];
    const double ofNoise = 1 / std::sqrt(static_cast<double>(motion.after.residuals.size()));
    if (motion.serialCorrelation > std::max(strongSerialCorrelation, surelyCorrelated * ofNoise))
      sentences.push_back(
          "What the fit leaves of " + quote(files[i]) +
          " is not noise: successive values are off alike, so the model lacks something, and the intervals are too "
          "narrow.");
    if (i < stabilities.size() && stabilities[i].state == harmonic::StabilityState::unstable)
      sentences.push_back("The motion that fits " + quote(files[i]) +
                          " is unstable, so it cannot have been measured; look for another one with \"start_scale\".");
  }
  return sentences;
}

Json CalibrationStudyResult::summary() const {
  Json json = summaryHead(*this);
  json["sample_count"] = calibration.sampleCount;
  json["failed_fits"] = calibration.failedFits;
  if (!calibration.history.empty()) {
    const auto &first = calibration.history.front(), &last = calibration.history.back();
    const auto& uncertainty = calibration.uncertainty;
    json["iterations"] = last.iteration;
    json["evaluations"] = last.evaluations;
    json["solves"] = last.solves;
    json["root_mean_square_before"] = first.rootMeanSquare;
    json["root_mean_square"] = last.rootMeanSquare;
    json["gradient_cosine"] = last.cosine;
    json["degrees_of_freedom"] = uncertainty.degreesOfFreedom;
    json["residual_standard_deviation"] = uncertainty.residualDeviation;
    json["confidence"] = confidence;
    json["parameters"] = fittedParameters(*this);
    json["parameter_count"] = json["parameters"].size();
    json["largest_correlation"] = largestCorrelation(uncertainty.correlation);
    json["undetermined_count"] = uncertainty.undetermined.cols();
    json["undetermined"] = undeterminedSentences();
    json["measurements"] = fittedMotions(*this);
    json["nodes"] = calibration.before->nodeCount();
    json["free_coordinates"] = calibration.before->dofs.freeCount();
  }
  json["harmonics"] = harmonics;
  json["samples"] = samples;
  json["units"] = {{"frequency", "rad/s"},
                   {"frequency_hz", "Hz"},
                   {"root_mean_square", "of fitted minus measured values, m"},
                   {"residual_standard_deviation", "m"},
                   {"error", "root mean square over that of the measured values from their means"},
                   {"time_offset", "the drive's time when the table's time is 0, s"},
                   {"gradient_cosine", "largest cosine between residuals and their derivative by a parameter"},
                   {"serial_correlation", "of successive residuals"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void CalibrationStudyResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  if (!calibration.history.empty()) {
    folder.writeFile("parameters.csv", fittedParameterTable(*this));
    folder.writeFile("correlation.csv", correlationTable(*this));
    folder.writeFile("history.csv", calibrationHistoryTable(*this));
    folder.writeFile("measured.csv", measuredTable(*this));
    folder.writeFile("fitted.csv", fittedTable(*this));
  }
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
