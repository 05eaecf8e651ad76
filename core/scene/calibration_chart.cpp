#include "core/scene/calibration_chart.hpp"

#include <numbers>

#include "core/base/units.hpp"
#include "core/scene/csv_table.hpp"

namespace pliant::scene {

namespace {

/// Adds the rows of a table to the series of their charts: one for each measurement, probe and axis.
void addRows(const CsvTable& table, const std::string& column, ResultSeries::Mark mark, const std::string& what,
             std::vector<ResultChart>& charts) {
  std::string last;
  int group = -1;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto measurement = static_cast<std::size_t>(table.integer(row, "measurement") - 1);
    if (measurement >= charts.size()) continue;
    ResultChart& chart = charts[measurement];
    const std::string coordinate = std::string(table.text(row, "probe")) + " " + std::string(table.text(row, "axis"));
    if (const std::string key = std::to_string(measurement) + coordinate; key != last) {
      group = last.substr(0, last.find_first_not_of("0123456789")) == std::to_string(measurement) ? group + 1 : 0;
      last = key;
      chart.series.push_back({coordinate + ", " + what, mark, {}, {}, group});
    }
    chart.series.back().x.push_back(table.number(row, "omega t [rad]") / (2 * std::numbers::pi));
    chart.series.back().y.push_back(1e3 * table.number(row, column));
  }
}

}  // namespace

std::vector<ResultChart> calibrationCharts(const std::filesystem::path& folder, const Json& summary) {
  using Mark = ResultSeries::Mark;
  std::vector<ResultChart> charts;
  for (const Json& measurement : summary.at("measurements"))
    charts.push_back(
        {measurement.at("file").get<std::string>() + ", ω = " +
             base::formatQuantity(measurement.at("frequency").get<double>(), base::dimensions::angularFrequency),
         "Time in the drive's period",
         "Measured and fitted [mm]",
         false,
         false,
         {}});
  const CsvTable fitted(folder / "fitted.csv");
  addRows(CsvTable(folder / "measured.csv"), "measured [m]", Mark::points, "measured", charts);
  addRows(fitted, "before [m]", Mark::dashedLine, "before", charts);
  addRows(fitted, "fitted [m]", Mark::line, "fitted", charts);
  return charts;
}

}  // namespace pliant::scene
