#include "core/scene/design_space_chart.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/scene/csv_table.hpp"

namespace pliant::scene {

namespace {

/// Millimetres and grams.
constexpr double perUnit = 1e3;

std::string labelOf(const Json& measure) {
  std::string label = measure.at("name");
  label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
  return label + (measure.at("unit") == "kg" ? " [g]" : " [mm]");
}

ResultChart measureChart(const CsvTable& designs, const Json& summary) {
  using Mark = ResultSeries::Mark;
  const Json& measures = summary.at("measures");
  std::array<std::string, 2> columns;
  for (std::size_t m = 0; m < 2; ++m)
    columns[m] = measures[m].at("name").get<std::string>() + " [" + measures[m].at("unit").get<std::string>() + "]";
  ResultSeries all{"designs", Mark::points, {}, {}, 0}, scene{"the scene's", Mark::points, {}, {}, 1},
      front{"none is better in both", Mark::line, {}, {}, 2};
  for (std::size_t row = 0; row < designs.size(); ++row) {
    if (designs.text(row, "motion") == "none") continue;
    const int design = designs.integer(row, "design");
    ResultSeries& series = design == 0 ? scene : all;
    series.designs.push_back(design);
    series.x.push_back(perUnit * designs.number(row, columns[0]));
    series.y.push_back(perUnit * designs.number(row, columns[1]));
  }
  for (const Json& design : summary.at("front")) {
    front.x.push_back(perUnit * design.at("measures")[0].get<double>());
    front.y.push_back(perUnit * design.at("measures")[1].get<double>());
    front.designs.push_back(design.at("design"));
  }
  ResultChart chart{std::to_string(summary.at("found_count").get<int>()) + " designs",
                    labelOf(measures[0]),
                    labelOf(measures[1]),
                    false,
                    false,
                    {}};
  for (ResultSeries* series : {&all, &front, &scene})
    if (!series->x.empty()) chart.series.push_back(std::move(*series));
  return chart;
}

/// The paths of one probe of some designs, in the two axes along which all together are longest.
ResultChart pathChart(const CsvTable& paths, const Json& summary, const std::string& probe) {
  constexpr int mostDesigns = 40;
  struct Axis {
    std::string name;
    std::vector<double> places;
    double spread() const {
      const auto [least, most] = std::minmax_element(places.begin(), places.end());
      return *most - *least;
    }
  };
  std::vector<Axis> axes;
  for (int axis = 0; axis < summary.at("dimension").get<int>(); ++axis) {
    Axis& added = axes.emplace_back(Axis{std::string(1, "xyz"[axis]), {}});
    for (std::size_t row = 0; row < paths.size(); ++row)
      added.places.push_back(perUnit * paths.number(row, probe + " " + added.name + " [m]"));
  }
  while (axes.size() > 2)
    axes.erase(std::min_element(
        axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.spread() < b.spread(); }));
  ResultChart chart{"Paths of " + probe, axes[0].name + " [mm]", axes[1].name + " [mm]", false, false, {}};
  const int stride = 1 + (summary.at("found_count").get<int>() - 1) / mostDesigns;
  int designs = 0, last = -1;
  bool shown = false;
  for (std::size_t row = 0; row < paths.size(); ++row) {
    const int design = paths.integer(row, "design");
    if (design != last) {
      last = design;
      const Json& front = summary.at("front");
      const bool onFront = std::any_of(
          front.begin(), front.end(), [&](const Json& each) { return each.at("design").get<int>() == design; });
      shown = design == 0 || onFront || designs % stride == 0;
      ++designs;
      if (shown) chart.series.push_back({"", ResultSeries::Mark::line, {}, {}, design == 0 ? 1 : onFront ? 2 : 0});
    }
    if (!shown) continue;
    chart.series.back().x.push_back(axes[0].places[row]);
    chart.series.back().y.push_back(axes[1].places[row]);
    chart.series.back().designs.push_back(design);
  }
  for (ResultSeries& series : chart.series) {  // closed
    series.x.push_back(series.x.front());
    series.y.push_back(series.y.front());
    series.designs.push_back(series.designs.front());
  }
  // The scene's last, above the others.
  std::stable_partition(
      chart.series.begin(), chart.series.end(), [](const ResultSeries& series) { return series.group != 1; });
  return chart;
}

}  // namespace

std::vector<ResultChart> designSpaceCharts(const std::filesystem::path& folder, const Json& summary) {
  std::vector<ResultChart> charts{measureChart(CsvTable(folder / "designs.csv"), summary)};
  const CsvTable paths(folder / "paths.csv");
  if (summary.at("dimension").get<int>() > 1 && paths.size() > 0)
    for (const Json& probe : summary.at("probes")) charts.push_back(pathChart(paths, summary, probe));
  return charts;
}

}  // namespace pliant::scene
