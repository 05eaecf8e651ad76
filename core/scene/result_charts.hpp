#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace pliant::scene {

/// One line of a chart, or its points; x and y have one size.
struct ResultSeries {
  enum class Mark { line, dashedLine, points };
  std::string name;  ///< in the legend; empty: it belongs to the series before it
  Mark mark = Mark::line;
  std::vector<double> x, y;
  int group = 0;               ///< series of one group have one colour
  std::vector<int> designs{};  ///< which one each point is of; empty if points are of none
};

/// What results on disk show when they are plotted; the units stand in the labels.
struct ResultChart {
  std::string title, xLabel, yLabel;
  bool logarithmicX = false, logarithmicY = false;
  std::vector<ResultSeries> series;
};

/// What can be drawn over the frequency: "path-length", "displacement", "strain".
std::vector<std::string> responseQuantities();

/// The charts of the results that `run` wrote into `folder`, of `studies` or, if there are none, of all that have a
/// result:
///  - response curves, with single motions and time integrations as points, in one chart: unstable parts are dashed,
///    peaks, folds and other bifurcations marked;
///  - comparisons of harmonic balance with Newmark's method in two: the error over the harmonics (Fig. 2.3 of the
///    thesis), and the difference over equally many samples and steps (Fig. 2.15);
///  - cloth: energy over time (Fig. 3.4), unbalanced forces of drapes, violations of limits and gaps of projections;
///  - calibrations: measured and fitted motions, see calibrationCharts;
///  - design spaces: designs by two measures, and paths, see designSpaceCharts.
/// Throws base::InputError if there is nothing to draw or `quantity` has another name.
std::vector<ResultChart> resultCharts(const Scene& scene, const std::filesystem::path& folder,
                                      const std::vector<std::string>& studies, const std::string& quantity);

}  // namespace pliant::scene
