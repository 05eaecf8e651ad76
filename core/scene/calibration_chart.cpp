#include "core/scene/calibration_chart.hpp"

#include <algorithm>
#include <numbers>

#include "core/base/units.hpp"
#include "core/scene/csv_table.hpp"

namespace pliant::scene {

namespace {

/// What belongs to one coordinate of one measurement.
struct CoordinateRows {
  std::size_t measurement;
  std::string name;
  std::vector<std::size_t> rows;
};

/// Rows of a table, which come coordinate after coordinate.
std::vector<CoordinateRows> coordinatesOf(const CsvTable& table) {
  std::vector<CoordinateRows> list;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto measurement = static_cast<std::size_t>(table.integer(row, "measurement") - 1);
    const std::string name = std::string(table.text(row, "probe")) + " " + std::string(table.text(row, "axis"));
    if (list.empty() || list.back().measurement != measurement || list.back().name != name)
      list.push_back({measurement, name, {}});
    list.back().rows.push_back(row);
  }
  return list;
}

ResultSeries seriesOf(const CsvTable& table, const CoordinateRows& coordinate, const char* column, double middle) {
  ResultSeries series;
  for (const std::size_t row : coordinate.rows) {
    series.x.push_back(table.number(row, "omega t [rad]") / (2 * std::numbers::pi));
    series.y.push_back(1e3 * (table.number(row, column) - middle));
  }
  return series;
}

}  // namespace

std::vector<ResultChart> calibrationCharts(const std::filesystem::path& folder, const Json& summary) {
  using Mark = ResultSeries::Mark;
  std::vector<ResultChart> charts;
  for (const Json& measurement : summary.at("measurements"))
    charts.push_back(
        {std::filesystem::path(measurement.at("file").get<std::string>()).filename().string() + ", ω = " +
             base::formatQuantity(measurement.at("frequency").get<double>(), base::dimensions::angularFrequency),
         "Time in the drive's period",
         "From the measured mean [mm]: measured, fitted, before (dashed)",
         false,
         false,
         {}});
  const CsvTable measured(folder / "measured.csv"), fitted(folder / "fitted.csv");
  const auto points = coordinatesOf(measured), curves = coordinatesOf(fitted);
  std::vector<int> groups(charts.size(), 0);
  for (std::size_t i = 0; i < std::min(points.size(), curves.size()); ++i) {
    const std::size_t chart = points[i].measurement;
    if (chart >= charts.size()) continue;
    double middle = 0;
    for (const std::size_t row : points[i].rows)
      middle += measured.number(row, "measured [m]") / static_cast<double>(points[i].rows.size());
    const auto add = [&](ResultSeries series, std::string name, Mark mark) {
      series.name = std::move(name);
      series.mark = mark;
      series.group = groups[chart];
      charts[chart].series.push_back(std::move(series));
    };
    add(seriesOf(measured, points[i], "measured [m]", middle), points[i].name, Mark::points);
    add(seriesOf(fitted, curves[i], "fitted [m]", middle), "", Mark::line);
    add(seriesOf(fitted, curves[i], "before [m]", middle), "", Mark::dashedLine);
    ++groups[chart];
  }
  return charts;
}

}  // namespace pliant::scene
