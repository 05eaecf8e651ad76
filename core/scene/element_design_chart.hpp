#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/element_design_result.hpp"
#include "core/scene/polar_curves.hpp"
#include "core/scene/result_charts.hpp"

namespace pliant::scene {

/// One wanted limit of a design, of the element that it started from, and of the best; NaN where there is none.
struct DesignedLimit {
  std::string name;  ///< "stretch", "compression", "ray"
  double angle;      ///< [rad]
  double wanted, before, after;
};

/// What a chart of a design shows.
struct DesignedLimits {
  std::string study;
  std::vector<DesignedLimit> limits;
  std::vector<double> iterations, residuals;  ///< of the elements on the way
};

DesignedLimits designedLimits(const ElementDesignStudyResult& result);
/// What such a study wrote into `directory`. Throws base::InputError.
DesignedLimits readDesignedLimits(const std::filesystem::path& directory);

/// Limits of stretch and compression of the first element and of the best, and those wanted, in per cent; broken where
/// directions are far apart. Without limits of directions it has no curves.
PolarCurves elementDesignCurves(const DesignedLimits& design);
/// The residual over the iterations.
ResultChart elementDesignChart(const DesignedLimits& design);

}  // namespace pliant::scene
