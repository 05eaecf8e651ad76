#pragma once

#include <filesystem>

#include "core/scene/result_charts.hpp"

namespace pliant::scene {

/// Charts of the design space in `folder`, whose summary.json is given: all designs by their two measures with those
/// that no other one beats, and the paths of each probe of at most 40 designs, in the plane in which it moves most.
/// Throws base::InputError if a table cannot be read.
std::vector<ResultChart> designSpaceCharts(const std::filesystem::path& folder, const Json& summary);

}  // namespace pliant::scene
