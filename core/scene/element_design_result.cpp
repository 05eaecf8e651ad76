#include "core/scene/element_design_result.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/result_folder.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

using interlock::DesignEnd;
using interlock::ElementIterate;

namespace {

std::string elementHistoryTable(const ElementDesignStudyResult& result) {
  CsvWriter csv;
  csv.add("iteration").add("residual").add("clearance [m]").add("step").add("promised_gain").add("evaluations");
  csv.add("failures").add("kinks");
  for (const DesignedNumber& each : result.numbers) {
    const std::string unit = base::siUnit(each.parameter.dimension);
    csv.add(each.parameter.name + (unit.empty() ? "" : " [" + unit + "]"));
  }
  csv.endRow();
  for (const ElementIterate& element : result.design.history) {
    csv.add(element.iteration).add(element.residual).add(element.clearance).add(element.stepSize);
    csv.add(element.stationarity).add(element.evaluations).add(element.failures).add(element.kinks);
    for (const double value : element.values) csv.add(value);
    csv.endRow();
  }
  return csv.text();
}

std::string elementNumberTable(const ElementDesignStudyResult& result) {
  CsvWriter csv;
  csv.add("parameter").add("unit").add("minimum").add("maximum").add("before").add("after").endRow();
  for (std::size_t i = 0; i < result.numbers.size(); ++i) {
    const auto& [parameter, lower, upper] = result.numbers[i];
    const auto index = static_cast<Eigen::Index>(i);
    csv.add(parameter.name).add(base::siUnit(parameter.dimension)).add(lower).add(upper);
    csv.add(result.design.history.front().values[index]).add(result.design.best().values[index]).endRow();
  }
  return csv.text();
}

std::string elementLimitTable(const ElementDesignStudyResult& result) {
  CsvWriter csv;
  for (const char* column : {"limit", "direction [rad]", "direction_mean", "direction_deviator", "direction_shear",
                             "at_least", "weight", "wanted", "before", "after"})
    csv.add(column);
  csv.endRow();
  for (std::size_t i = 0; i < result.goals.size(); ++i) {
    const ElementGoal& goal = result.goals[i];
    const auto index = static_cast<Eigen::Index>(i);
    csv.add(goal.name()).add(goal.angle);
    for (const double coordinate : goal.direction) csv.add(coordinate);
    csv.add(goal.limit.kind == interlock::LimitGoal::Kind::atLeast ? 1 : 0).add(goal.limit.weight);
    for (const double value :
         {goal.limit.wanted, result.design.history.front().limits[index], result.design.best().limits[index]}) {
      if (std::isfinite(value))
        csv.add(goal.shown(value));
      else
        csv.add("");
    }
    csv.endRow();
  }
  return csv.text();
}

}  // namespace

std::string_view nameOf(DesignEnd end) {
  switch (end) {
    case DesignEnd::reached: return "reached";
    case DesignEnd::stationary: return "stationary";
    case DesignEnd::kink: return "kink";
    case DesignEnd::other: break;
  }
  return "other";
}

Json designedEntry(const ElementDesignStudyResult& result, const ElementIterate& element) {
  Json entry = result.entry;
  for (std::size_t i = 0; i < result.numbers.size(); ++i)
    entry[Json::json_pointer("/" + result.numbers[i].parameter.name)] = element.values[static_cast<Eigen::Index>(i)];
  return entry;
}

Json designedElementScene(const Scene& scene, const ElementDesignStudyResult& result, const ElementIterate& element) {
  Json json = scene.json();
  const std::string entry = childPointer("/interlocking_cells", result.cellIndex);
  for (std::size_t i = 0; i < result.numbers.size(); ++i) {
    const Json::json_pointer place(entry + "/" + result.numbers[i].parameter.name);
    if (!scene.normalized().contains(place))
      throw base::InputError(scene.name() + ": " + place.to_string(), "The scene has no such value any more.");
    json[place] = element.values[static_cast<Eigen::Index>(i)];
  }
  return json;
}

std::vector<std::string> ElementDesignStudyResult::warnings() const {
  std::vector<std::string> sentences;
  if (design.history.empty()) return sentences;
  const ElementIterate& best = design.best();
  if (best.clearance < wantedClearance * (1 - 1e-6))
    sentences.emplace_back("The gaps at rest are narrower than the clearance that was asked for.");
  for (const ElementGoal& goal : goals)
    if (goal.kind == ElementGoal::Kind::compression) {
      sentences.emplace_back(
          "Compression limits hold for this supercell and its ways to fold: an element found for them may fold "
          "otherwise in larger pieces.");
      break;
    }
  if (best.kinks > 0)
    sentences.push_back("The derivatives of " + std::to_string(best.kinks) +
                        " limits do not hold at the element found, since contacts change there.");
  return sentences;
}

Json ElementDesignStudyResult::summary() const {
  Json json = materialSummary();
  json["evaluations"] = design.evaluations;
  json["failed_elements"] = design.failures;
  json["goals"] = goals.size();
  if (!design.history.empty()) {
    const ElementIterate &before = design.history.front(), &best = design.best();
    json["end"] = nameOf(design.end);
    json["iterations"] = best.iteration;
    json["residual_before"] = before.residual;
    json["residual"] = best.residual;
    double largest = 0;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const double difference = best.limits[static_cast<Eigen::Index>(i)] - goals[i].limit.wanted;
      const bool atLeast = goals[i].limit.kind == interlock::LimitGoal::Kind::atLeast;
      largest = std::max(largest, atLeast ? std::max(0.0, -difference) : std::abs(difference));
    }
    json["largest_difference"] = largest;
    json["promised_gain"] = best.stationarity;
    json["clearance_before"] = before.clearance;
    json["clearance"] = best.clearance;
    json["clearance_wanted"] = wantedClearance;
    json["kinks"] = best.kinks;
    Json list = Json::array();
    for (std::size_t i = 0; i < numbers.size(); ++i)
      list.push_back({{"name", numbers[i].parameter.name},
                      {"before", before.values[static_cast<Eigen::Index>(i)]},
                      {"value", best.values[static_cast<Eigen::Index>(i)]},
                      {"unit", base::siUnit(numbers[i].parameter.dimension)}});
    json["parameters"] = list;
  }
  json["units"] = {{"residual", "root mean square difference to the wanted limits, strain"},
                   {"largest_difference", "strain"},
                   {"promised_gain", "that a step is predicted to take from the residual's square, over it"},
                   {"clearance", "smallest gap at rest, m"},
                   {"kinks", "limits whose derivatives do not hold"},
                   {"seconds", "s"}};
  addRunInformation(json, *this);
  return json;
}

void ElementDesignStudyResult::write(const std::filesystem::path& directory) const {
  ResultFolder folder(directory);
  if (!design.history.empty()) {
    folder.writeFile("history.csv", elementHistoryTable(*this));
    folder.writeFile("parameters.csv", elementNumberTable(*this));
    folder.writeFile("limits.csv", elementLimitTable(*this));
    folder.writeFile("element.json", formatJson(designedEntry(*this, design.best())));
  }
  folder.writeFile("summary.json", formatJson(summary()));
  folder.commit();
}

}  // namespace pliant::scene
