#include "core/scene/calibration_tables.hpp"

#include <cmath>
#include <numbers>

#include "core/harmonic/path_length.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/csv.hpp"

namespace pliant::scene {

using harmonic::CalibratedMotion;
using harmonic::MeasuredCoordinate;
using harmonic::MeasuredMotion;
using mechanics::Vector;
using std::numbers::pi;

namespace {

constexpr std::string_view axisLetters = "xyz";

void addOrEmpty(CsvWriter& csv, double value) {
  if (std::isfinite(value))
    csv.add(value);
  else
    csv.add("");
}

std::string probeOf(const mechanics::Model& model, int node) {
  for (const mechanics::Probe& probe : model.probes)
    if (probe.node == node) return probe.name;
  return {};
}

/// The angle in [0, 2π).
double wrapped(double angle) {
  const double rest = std::fmod(angle, 2 * pi);
  return rest < 0 ? rest + 2 * pi : rest;
}

void addCoordinate(CsvWriter& csv, const CalibrationStudyResult& result, std::size_t measurement,
                   const MeasuredCoordinate& coordinate) {
  csv.add(static_cast<long>(measurement) + 1).add(probeOf(*result.calibration.before, coordinate.node));
  csv.add(axisLetters.substr(static_cast<std::size_t>(coordinate.axis), 1));
}

}  // namespace

std::string fittedParameterTable(const CalibrationStudyResult& result) {
  CsvWriter csv;
  csv.add("parameter").add("pointer").add("unit").add("minimum").add("maximum").add("before").add("value");
  csv.add("standard error").add("lower").add("upper").endRow();
  const mechanics::Model& model = *result.calibration.before;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const auto& parameter = *model.parameters[i];
    const auto index = static_cast<Eigen::Index>(i);
    const double value = result.calibration.history.back().values[index];
    const double halfWidth = result.calibration.uncertainty.halfWidths[index];
    csv.add(parameter.name()).add(parameter.pointer()).add(base::siUnit(parameter.dimension()));
    csv.add(parameter.minimum(model)).add(parameter.maximum(model));
    csv.add(result.calibration.history.front().values[index]).add(value);
    addOrEmpty(csv, result.calibration.uncertainty.standardErrors[index]);
    addOrEmpty(csv, value - halfWidth);
    addOrEmpty(csv, value + halfWidth);
    csv.endRow();
  }
  return csv.text();
}

std::string correlationTable(const CalibrationStudyResult& result) {
  CsvWriter csv;
  csv.add("parameter");
  const auto& parameters = result.calibration.before->parameters;
  for (const auto& parameter : parameters) csv.add(parameter->name());
  csv.endRow();
  const mechanics::Matrix& correlation = result.calibration.uncertainty.correlation;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    csv.add(parameters[i]->name());
    for (Eigen::Index j = 0; j < correlation.cols(); ++j) addOrEmpty(csv, correlation(static_cast<Eigen::Index>(i), j));
    csv.endRow();
  }
  return csv.text();
}

std::string calibrationHistoryTable(const CalibrationStudyResult& result) {
  CsvWriter csv;
  csv.add("iteration").add("root mean square [m]").add("gradient cosine").add("evaluations").add("solves");
  for (const auto& parameter : result.calibration.before->parameters) {
    const std::string unit = base::siUnit(parameter->dimension());
    csv.add(parameter->name() + (unit.empty() ? "" : " [" + unit + "]"));
  }
  csv.endRow();
  for (const harmonic::CalibrationIterate& at : result.calibration.history) {
    csv.add(at.iteration).add(at.rootMeanSquare).add(at.cosine).add(at.evaluations).add(at.solves);
    for (const double value : at.values) csv.add(value);
    csv.endRow();
  }
  return csv.text();
}

std::string measuredTable(const CalibrationStudyResult& result) {
  CsvWriter csv;
  csv.add("measurement").add("probe").add("axis").add("time [s]").add("omega t [rad]");
  csv.add("measured [m]").add("fitted [m]").endRow();
  for (std::size_t m = 0; m < result.calibration.motions.size(); ++m) {
    const MeasuredMotion& measured = result.measured[m];
    const CalibratedMotion& motion = result.calibration.motions[m];
    Eigen::Index row = 0;
    for (const MeasuredCoordinate& coordinate : measured.coordinates)
      for (Eigen::Index i = 0; i < measured.times.size(); ++i) {
        if (std::isnan(coordinate.values[i])) continue;
        addCoordinate(csv, result, m, coordinate);
        csv.add(measured.times[i]).add(wrapped(measured.omega * measured.times[i] + motion.after.phase));
        csv.add(coordinate.values[i]).add(motion.after.fitted[row++]).endRow();
      }
  }
  return csv.text();
}

std::string fittedTable(const CalibrationStudyResult& result) {
  constexpr int instants = 128;
  CsvWriter csv;
  csv.add("measurement").add("probe").add("axis").add("omega t [rad]").add("before [m]").add("fitted [m]").endRow();
  const math::HarmonicBasis basis(result.harmonics, result.samples);
  const harmonic::HarmonicBalanceProblem first(result.calibration.before, basis), last(result.calibration.after, basis);
  for (std::size_t m = 0; m < result.calibration.motions.size(); ++m) {
    const MeasuredMotion& measured = result.measured[m];
    const CalibratedMotion& motion = result.calibration.motions[m];
    Eigen::Index row = 0;
    for (const MeasuredCoordinate& coordinate : measured.coordinates) {
      const Vector before = harmonic::nodeCoefficients(first, motion.zBefore, coordinate.node).col(coordinate.axis);
      const Vector after = harmonic::nodeCoefficients(last, motion.z, coordinate.node).col(coordinate.axis);
      // What the first measured value says of the place that values are measured from.
      Eigen::Index known = 0;
      while (std::isnan(coordinate.values[known])) ++known;
      const double at = measured.omega * measured.times[known];
      const double placeBefore = motion.before.fitted[row] - basis.valuesAt(at + motion.before.phase).dot(before);
      const double place = motion.after.fitted[row] - basis.valuesAt(at + motion.after.phase).dot(after);
      for (int i = 0; i <= instants; ++i) {
        const double tau = 2 * pi * i / instants;
        addCoordinate(csv, result, m, coordinate);
        csv.add(tau).add(placeBefore + basis.valuesAt(tau - motion.after.phase + motion.before.phase).dot(before));
        csv.add(place + basis.valuesAt(tau).dot(after)).endRow();
      }
      row += (coordinate.values.array() == coordinate.values.array()).count();
    }
  }
  return csv.text();
}

}  // namespace pliant::scene
