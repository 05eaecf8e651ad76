#pragma once

#include <string>
#include <vector>

#include "core/base/units.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// One line of a chart; x and y have one size.
struct ChartSeries {
  std::string name;
  Vector x, y;
};

struct ChartAxis {
  std::string label;
  base::Dimension dimension;
  bool logarithmic = false;
};

/// What one periodic motion shows when it is plotted, in SI.
struct MotionChart {
  enum class Style {
    line,
    closedLine,  ///< the last point joins the first
    stems,       ///< a stem from the axis to each point
  };

  Style style = Style::line;
  ChartAxis x, y;
  std::vector<ChartSeries> series;
  std::string note;  ///< one sentence instead, where there is nothing to show
};

/// A kind of chart of a motion `z` at `omega` [rad/s]; some are of one node.
struct MotionChartKind {
  std::string key;          ///< "harmonics"
  std::string title;        ///< "Harmonic content"
  std::string description;  ///< one sentence
  bool ofNode = true;
  MotionChart (*make)(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int node);
};

/// Harmonic content, position and velocity over a period, phase plane, strain, violation of rigid constraints.
const std::vector<MotionChartKind>& motionChartKinds();

}  // namespace pliant::harmonic
