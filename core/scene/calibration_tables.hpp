#pragma once

#include <string>

#include "core/scene/calibration_result.hpp"

namespace pliant::scene {

/// The tables beside the summary.json of a calibration. Cells are empty where there is no number.
std::string fittedParameterTable(const CalibrationStudyResult& result);
std::string correlationTable(const CalibrationStudyResult& result);
std::string calibrationHistoryTable(const CalibrationStudyResult& result);
/// A row a measured value, at its place in the drive's period.
std::string measuredTable(const CalibrationStudyResult& result);
/// A row an instant of the period and coordinate, with the first and the last parameters, in terms of the measured
/// values.
std::string fittedTable(const CalibrationStudyResult& result);

}  // namespace pliant::scene
