#include "core/scene/element_design_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/scene/csv_table.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

namespace {

constexpr double noLimit = std::numeric_limits<double>::quiet_NaN();

struct DesignCurveStyle {
  const char* name;
  double DesignedLimit::*value;
  bool dashed;
  double width;
};

/// Where directions leave out far more than elsewhere nothing is known: one without values keeps curves apart there.
void breakAtGaps(std::vector<DesignedLimit>& limits) {
  constexpr double farther = 2.5, halfTurn = std::numbers::pi;
  const std::vector<DesignedLimit> known = limits;
  const auto gapAfter = [&](std::size_t i) {
    return i + 1 < known.size() ? known[i + 1].angle - known[i].angle
                                : known.front().angle + halfTurn - known.back().angle;
  };
  double smallest = halfTurn;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (gapAfter(i) > 1e-9) smallest = std::min(smallest, gapAfter(i));
  for (std::size_t i = 0; i < known.size(); ++i)
    if (gapAfter(i) > farther * smallest)
      limits.push_back(
          {known[i].name, std::fmod(known[i].angle + 0.5 * gapAfter(i), halfTurn), noLimit, noLimit, noLimit});
  std::stable_sort(limits.begin(), limits.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
}

}  // namespace

DesignedLimits designedLimits(const ElementDesignStudyResult& result) {
  DesignedLimits design{result.provenance.study, {}, {}, {}};
  if (result.design.history.empty()) return design;
  const auto& history = result.design.history;
  for (std::size_t i = 0; i < result.goals.size(); ++i) {
    const ElementGoal& goal = result.goals[i];
    const auto shown = [&](double value) { return std::isfinite(value) ? goal.shown(value) : noLimit; };
    const auto index = static_cast<Eigen::Index>(i);
    design.limits.push_back({std::string(goal.name()), goal.angle, shown(goal.limit.wanted),
                             shown(history.front().limits[index]), shown(history.back().limits[index])});
  }
  for (const interlock::ElementIterate& element : history) {
    design.iterations.push_back(element.iteration);
    design.residuals.push_back(element.residual);
  }
  return design;
}

DesignedLimits readDesignedLimits(const std::filesystem::path& directory) {
  DesignedLimits design{parseJson(readTextFile(directory / "summary.json")).value("study", ""), {}, {}, {}};
  const CsvTable limits(directory / "limits.csv"), history(directory / "history.csv");
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const auto number = [&](const char* column) {
      return limits.text(i, column).empty() ? noLimit : limits.number(i, column);
    };
    design.limits.push_back({std::string(limits.text(i, "limit")), limits.number(i, "direction [rad]"),
                             number("wanted"), number("before"), number("after")});
  }
  for (std::size_t i = 0; i < history.size(); ++i) {
    design.iterations.push_back(history.number(i, "iteration"));
    design.residuals.push_back(history.number(i, "residual"));
  }
  return design;
}

PolarCurves elementDesignCurves(const DesignedLimits& design) {
  PolarCurves all{design.study, "%", 100, 3, {}};
  for (const char* kind : {"stretch", "compression"}) {
    std::vector<DesignedLimit> own;
    for (const DesignedLimit& limit : design.limits)
      if (limit.name == kind) own.push_back(limit);
    if (own.empty()) continue;
    for (DesignedLimit& limit : own) {
      // Limits are the same in opposite directions.
      limit.angle = std::fmod(limit.angle, std::numbers::pi);
      if (limit.angle < 0) limit.angle += std::numbers::pi;
    }
    std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
    breakAtGaps(own);
    // What is wanted stays visible over what is found.
    for (const auto& [name, value, dashed, width] : {DesignCurveStyle{"first", &DesignedLimit::before, false, 0.8},
                                                     DesignCurveStyle{"found", &DesignedLimit::after, false, 2.6},
                                                     DesignCurveStyle{"wanted", &DesignedLimit::wanted, true, 1.2}}) {
      PolarCurve curve{std::string(kind) + " " + name, {}, {}, {}, true, dashed, width};
      for (const DesignedLimit& limit : own) {
        curve.angles.push_back(limit.angle);
        curve.values.push_back(limit.*value);
      }
      all.curves.push_back(std::move(curve));
    }
  }
  return all;
}

ResultChart elementDesignChart(const DesignedLimits& design) {
  ResultChart chart;
  chart.title = "Difference to the wanted limits";
  chart.xLabel = "iteration";
  chart.yLabel = "root mean square [strain]";
  chart.logarithmicY = true;
  ResultSeries series;
  series.name = design.study;
  series.x = design.iterations;
  series.y = design.residuals;
  chart.series.push_back(std::move(series));
  return chart;
}

}  // namespace pliant::scene
