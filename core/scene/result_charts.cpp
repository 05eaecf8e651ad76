#include "core/scene/result_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/calibration_chart.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/design_space_chart.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

namespace {

using base::InputError;
using Mark = ResultSeries::Mark;

/// What response.csv says of each point, of each probe or of the model.
struct ResponseQuantity {
  std::string_view key;
  std::string_view label;
  std::string_view column;  ///< of response.csv, after the probe's name if it is of a probe
  double perUnit;           ///< of the label, of what is in SI
  const char* json;         ///< of a probe in a time integration's summary; null: not in there
};

constexpr std::array<ResponseQuantity, 3> quantities{{
    {"path-length", "Path length [mm]", " path length [m]", 1e3, "path_length"},
    {"displacement", "Largest displacement [mm]", " maximum displacement [m]", 1e3, "maximum_displacement"},
    {"strain", "Largest strain", "largest strain", 1, nullptr},
}};

/// A table with its header, by column.
class Table {
 public:
  explicit Table(const std::filesystem::path& file) : file_(file), text_(readTextFile(file)) {
    try {
      rows_ = readCsv(text_);
    } catch (const InputError& error) {
      throw InputError(file.string(), error.problem());
    }
    std::istringstream header(text_.substr(0, text_.find('\n')));
    for (std::string name; std::getline(header, name, ',');) names_.push_back(name);
  }

  const std::vector<std::string>& names() const { return names_; }
  std::vector<std::string> texts(std::string_view column) const {
    std::vector<std::string> result;
    for (const auto& row : rows_) result.emplace_back(row[indexOf(column)]);
    return result;
  }
  /// `ifEmpty` stands for cells that are empty, which are an error where it is not a number.
  std::vector<double> numbers(std::string_view column, double factor,
                              double ifEmpty = std::numeric_limits<double>::quiet_NaN()) const {
    std::vector<double> result;
    for (const auto& row : rows_) {
      const std::string_view cell = row[indexOf(column)];
      try {
        result.push_back(cell.empty() && std::isfinite(ifEmpty) ? ifEmpty : factor * csvNumber(cell));
      } catch (const InputError& error) {
        throw InputError(file_.string(), error.problem());
      }
    }
    return result;
  }

 private:
  std::size_t indexOf(std::string_view column) const {
    const auto found = std::find(names_.begin(), names_.end(), column);
    if (found == names_.end())
      throw InputError(file_.string(), "This table has no column " + quote(std::string(column)) + ".");
    return static_cast<std::size_t>(found - names_.begin());
  }

  std::filesystem::path file_;
  std::string text_;
  std::vector<std::vector<std::string_view>> rows_;
  std::vector<std::string> names_;
};

/// A study's result on disk.
struct Found {
  std::string study;
  std::filesystem::path folder;
  Json summary;
  std::string kind() const {
    const auto known = summary.find("kind");
    return known != summary.end() && known->is_string() ? known->get<std::string>() : std::string();
  }
};

std::vector<Found> findResults(const Scene& scene, const std::filesystem::path& folder,
                               const std::vector<std::string>& studies) {
  std::vector<Found> found;
  for (const std::string& study : studies.empty() ? studyNames(scene) : studies) {
    const std::filesystem::path file = folder / study / "summary.json";
    if (!std::filesystem::exists(file)) {
      if (studies.empty()) continue;
      throw InputError(folder.string(), "There is no result of the study " + quote(study) + ".");
    }
    found.push_back({study, folder / study, parseJson(readTextFile(file))});
  }
  return found;
}

class ResponseChart {
 public:
  ResponseChart(const Scene& scene, const ResponseQuantity& quantity) : quantity_(quantity) {
    chart_.title = scene.normalized().at("title").get<std::string>();
    chart_.xLabel = "Frequency ω [rad/s]";
    chart_.yLabel = quantity.label;
  }

  void add(const Found& found) {
    if (found.kind() == "time") return addTime(found);
    const Table table(found.folder / "response.csv");
    for (const std::string& column : table.names())
      if (column.ends_with(quantity_.column)) {
        const std::string probe = column.substr(0, column.size() - quantity_.column.size());
        addCurve(table, column, probe, found.study + (probe.empty() ? "" : ", ") + probe);
      }
  }

  ResultChart take() { return std::move(chart_); }

 private:
  void addSeries(const std::string& name, Mark mark, std::vector<double> x, std::vector<double> y) {
    if (!x.empty()) chart_.series.push_back({name, mark, std::move(x), std::move(y), group_});
  }

  void addTime(const Found& found) {
    if (!quantity_.json) return;
    for (const Json& probe : found.summary.at("probes")) {
      addSeries(found.study + ", " + probe.at("name").get<std::string>(), Mark::points,
                {found.summary.at("frequency").get<double>()},
                {quantity_.perUnit * probe.at(quantity_.json).get<double>()});
      ++group_;
    }
  }

  /// Pieces of one stability each, which share their ends, and the special points. A piece between two points is
  /// unstable if one of them is.
  void addCurve(const Table& table, const std::string& column, const std::string& probe, const std::string& name) {
    const std::vector<double> omega = table.numbers("omega [rad/s]", 1);
    const std::vector<double> value = table.numbers(column, quantity_.perUnit);
    const std::vector<std::string> kind = table.texts("kind"), peakOf = table.texts("peak of");
    const std::vector<std::string> branch = table.texts("branch"), stability = table.texts("stability");
    if (omega.size() == 1) {
      addSeries(name, Mark::points, omega, value);
      ++group_;
      return;
    }
    std::vector<double> specialOmega, specialValue;
    for (std::size_t i = 0; i < omega.size(); ++i) {
      if (kind[i] == "regular" || (!probe.empty() && !peakOf[i].empty() && peakOf[i] != probe)) continue;
      specialOmega.push_back(omega[i]);
      specialValue.push_back(value[i]);
    }
    const auto unstable = [&](std::size_t i) { return stability[i] == "unstable"; };
    std::string title = name;
    for (std::size_t begin = 0; begin + 1 < omega.size();) {
      std::size_t end = begin + 1;
      if (branch[end] != branch[begin]) {
        begin = end;
        continue;
      }
      const bool dashed = unstable(begin) || unstable(end);
      while (end + 1 < omega.size() && branch[end + 1] == branch[begin] &&
             (unstable(end) || unstable(end + 1)) == dashed)
        ++end;
      const auto from = static_cast<std::ptrdiff_t>(begin), to = static_cast<std::ptrdiff_t>(end) + 1;
      addSeries(title, dashed ? Mark::dashedLine : Mark::line, {omega.begin() + from, omega.begin() + to},
                {value.begin() + from, value.begin() + to});
      title.clear();
      begin = end;
    }
    addSeries("", Mark::points, specialOmega, specialValue);
    ++group_;
  }

  const ResponseQuantity& quantity_;
  ResultChart chart_;
  int group_ = 0;
};

/// A series of one list of a comparison's summary; without what failed, and what a logarithmic axis cannot show.
ResultSeries comparedSeries(const std::string& name, const Json& solutions, const char* x, const char* y, int group) {
  ResultSeries series{name, Mark::line, {}, {}, group};
  for (const Json& solution : solutions) {
    const double value = solution.value(y, 0.0);
    if (!(value > 0) || solution.at("termination") != "converged") continue;
    series.x.push_back(solution.at(x).get<double>());
    series.y.push_back(value);
  }
  return series;
}

void addPoints(ResultChart& chart, ResultSeries series) {
  chart.series.push_back(series);
  series.name.clear();
  series.mark = Mark::points;
  chart.series.push_back(std::move(series));
}

std::vector<ResultChart> comparisonCharts(const std::vector<Found>& comparisons) {
  ResultChart harmonics{"Error of harmonic balance", "Harmonics H", "Error relative to the swing", false, true, {}};
  ResultChart samples{"Harmonic balance against Newmark's method",
                      "Samples and time steps of a period N",
                      "Difference relative to the swing",
                      true,
                      true,
                      {}};
  int group = 0;
  for (const Found& found : comparisons) {
    const std::string at =
        "ω = " + base::formatQuantity(found.summary.at("frequency").get<double>(), base::dimensions::angularFrequency);
    addPoints(harmonics, comparedSeries(at, found.summary.at("harmonics"), "harmonics",
                                        "relative_difference_to_reference", group));
    addPoints(
        samples, comparedSeries(at, found.summary.at("samples"), "samples", "relative_difference_to_newmark", group));
    ++group;
  }
  return {harmonics, samples};
}

/// Without what a logarithmic axis cannot show.
ResultSeries positivePart(ResultSeries series) {
  ResultSeries kept{series.name, series.mark, {}, {}, series.group};
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (series.y[i] > 0) {
      kept.x.push_back(series.x[i]);
      kept.y.push_back(series.y[i]);
    }
  return kept;
}

/// Energy over time of motions (thesis Fig. 3.4), in its parts where there is one alone; drapes over their steps; and
/// how well limits were kept.
std::vector<ResultChart> clothCharts(const std::vector<Found>& cloths) {
  ResultChart energy{"Energy", "Time [s]", "Energy [mJ]", false, false, {}};
  ResultChart drape{"Unbalanced force", "Step", "Over the external force", false, true, {}};
  ResultChart limits{"How well limits are kept", "Time [s] or step", "Violation, relative gap", false, true, {}};
  int group = 0;
  for (const Found& found : cloths) {
    const Table table(found.folder / "steps.csv");
    const std::vector<double> time = table.numbers("time [s]", 1);
    const auto add = [&](ResultChart& chart, const std::string& name, std::string_view column, double factor,
                         Mark mark) {
      ResultSeries series{name, mark, time, table.numbers(column, factor, 0), group};
      if (chart.logarithmicY) series = positivePart(std::move(series));
      if (!series.x.empty()) chart.series.push_back(std::move(series));
    };
    const bool isDrape = found.summary.at("type") == "cloth_drape";
    if (isDrape)
      add(drape, found.study, "residual", 1, Mark::line);
    else
      add(energy, found.study + ", total", "total [J]", 1e3, Mark::line);
    add(limits, found.study + ", violation", "violation", 1, Mark::line);
    add(limits, found.study + ", relative gap", "relative gap", 1, Mark::dashedLine);
    ++group;
    if (cloths.size() == 1 && !isDrape)
      for (const std::string part : {"kinetic", "membrane", "bending", "gravity"}) {
        add(energy, part, part + " [J]", 1e3, Mark::line);
        ++group;
      }
  }
  std::vector<ResultChart> charts;
  for (ResultChart* chart : {&energy, &drape, &limits})
    if (!chart->series.empty()) charts.push_back(std::move(*chart));
  return charts;
}

}  // namespace

std::vector<std::string> responseQuantities() {
  std::vector<std::string> keys;
  for (const ResponseQuantity& quantity : quantities) keys.emplace_back(quantity.key);
  return keys;
}

std::vector<ResultChart> resultCharts(const Scene& scene, const std::filesystem::path& folder,
                                      const std::vector<std::string>& studies, const std::string& quantity) {
  const auto* chosen =
      std::find_if(quantities.begin(), quantities.end(), [&](const auto& known) { return known.key == quantity; });
  if (chosen == quantities.end()) throw InputError("--quantity", "There is no quantity " + quote(quantity) + ".");
  std::vector<ResultChart> charts;
  try {
    ResponseChart response(scene, *chosen);
    std::vector<Found> comparisons, cloths;
    for (const Found& found : findResults(scene, folder, studies)) {
      if (found.kind() == "comparison")
        comparisons.push_back(found);
      else if (found.kind() == "cloth" && found.summary.value("steps", 0) > 0)
        cloths.push_back(found);
      else if (found.kind() == "calibration" && found.summary.contains("measurements"))
        for (ResultChart& chart : calibrationCharts(found.folder, found.summary)) charts.push_back(std::move(chart));
      else if (found.kind() == "design_space" && found.summary.value("found_count", 0) > 0)
        for (ResultChart& chart : designSpaceCharts(found.folder, found.summary)) charts.push_back(std::move(chart));
      else if (found.kind() == "harmonic" || found.kind() == "time")
        response.add(found);
      else if (!studies.empty())
        throw InputError(folder.string(), "The result of " + quote(found.study) + " has no chart.");
    }
    if (ResultChart chart = response.take(); !chart.series.empty()) charts.push_back(std::move(chart));
    if (!comparisons.empty())
      for (ResultChart& chart : comparisonCharts(comparisons)) charts.push_back(std::move(chart));
    for (ResultChart& chart : clothCharts(cloths)) charts.push_back(std::move(chart));
  } catch (const Json::exception&) {
    throw InputError(folder.string(), "A result in this folder lacks what a chart needs; run its study again.");
  }
  if (charts.empty()) throw InputError(folder.string(), "This folder has no result that a chart can show.");
  return charts;
}

}  // namespace pliant::scene
