#pragma once

#include <memory>
#include <vector>

#include "core/scene/cloth_result.hpp"
#include "ui/plots/line_plot.hpp"

namespace pliant::panels {

/// What a study of a cloth has found so far.
struct ClothRun {
  QString name;
  std::shared_ptr<const scene::ClothResult> result;
  int group = 0;             ///< its colour, wherever it stands
  bool countsSteps = false;  ///< rather than seconds: a drape
};

/// A chart of one or several runs.
struct ClothChartKind {
  QString title;
  QString description;
  bool ofMany = false;  ///< shows all runs; else the first
  bool overTime = false;
  plots::LineChart (*make)(const std::vector<ClothRun>& runs);
};

/// Total energy over time (Figs. 3.4 and 3.5 of the thesis), its parts, what the limits are broken by, gaps and
/// iterations of the projections, the last projection's convergence, the smallest distance.
const std::vector<ClothChartKind>& clothChartKinds();

}  // namespace pliant::panels
