#pragma once

#include <filesystem>

#include "core/harmonic/measured_motion.hpp"

namespace pliant::scene {

/// Reads times and coordinates of a measured motion from a comma-separated table: a column "time [s]" and columns like
/// "tip x [mm]", a probe's name, an axis and any unit of length; cells may be empty where nothing was seen, but for
/// the time; empty lines and lines that begin with # do not count. Columns of axes that `axes` (0: x, ...) does not
/// hold are left out, unless it is empty. Throws base::InputError with FILE:LINE as location.
harmonic::MeasuredMotion readMeasurement(const std::filesystem::path& file, const mechanics::Model& model,
                                         const std::vector<int>& axes);

}  // namespace pliant::scene
