#pragma once

#include <filesystem>

#include "core/scene/result_charts.hpp"

namespace pliant::scene {

/// A chart a measurement of the calibration in `folder`, whose summary.json is given: measured values over the drive's
/// period, and what the model gives before (dashed) and after. Throws base::InputError if a table cannot be read.
std::vector<ResultChart> calibrationCharts(const std::filesystem::path& folder, const Json& summary);

}  // namespace pliant::scene
