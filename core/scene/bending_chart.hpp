#pragma once

#include "core/scene/bending_result.hpp"
#include "core/scene/result_charts.hpp"

namespace pliant::scene {

/// Absolute limits of curvature over the radius of the patch (thesis Fig. 4.8): bent in one direction, domes and
/// saddles; up in full lines, down in dashed ones. Lines have gaps where a patch folds, or where limits are not known
/// yet.
ResultChart bendingSizeChart(const BendingSizeResult& result);

}  // namespace pliant::scene
