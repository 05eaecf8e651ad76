#include "ui/panels/limit_entry.hpp"

#include <QString>
#include <array>
#include <numbers>
#include <string>

namespace pliant::panels {

namespace {

constexpr std::array<const char*, 3> methodNames{"auto", "ellipses", "directions"};

std::string degreesText(double radians) {
  return QString::number(radians * 180 / std::numbers::pi, 'g', 12).toStdString() + " deg";
}

}  // namespace

cloth::StretchLimit limitOf(const Json& entry) {
  const std::string type = entry.at("type").get<std::string>();
  if (type == "isotropic") return cloth::IsotropicLimit{entry.at("stretch").get<double>()};
  if (type == "orthotropic")
    return cloth::OrthotropicLimit{
        entry.at("first").get<double>(), entry.at("second").get<double>(), entry.value("angle", 0.0)};
  std::vector<cloth::DirectionLimit> points;
  for (const Json& point : entry.at("points"))
    points.push_back({point.at("angle").get<double>(), point.at("stretch").get<double>()});
  return cloth::LimitCurve(std::move(points));
}

ConstraintChoice constraintChoiceOf(const Json& entry) {
  ConstraintChoice choice;
  if (const auto directions = entry.find("directions"); directions != entry.end() && directions->is_number())
    return {ConstraintMethod::directions, directions->get<int>()};
  const std::string name = entry.value("constraints", methodNames[0]);
  for (std::size_t i = 0; i < methodNames.size(); ++i)
    if (name == methodNames[i]) choice.method = static_cast<ConstraintMethod>(i);
  choice.count = entry.value("count", choice.count);
  return choice;
}

Json entryWith(const Json& entry, const cloth::StretchLimit& limit, const ConstraintChoice& choice) {
  Json changed = entry.is_object() ? entry : Json::object();
  for (const char* key : {"stretch", "first", "second", "angle", "points", "constraints", "count", "directions"})
    changed.erase(key);
  if (const auto* isotropic = std::get_if<cloth::IsotropicLimit>(&limit)) {
    changed["type"] = "isotropic";
    changed["stretch"] = isotropic->stretch;
  } else if (const auto* orthotropic = std::get_if<cloth::OrthotropicLimit>(&limit)) {
    changed["type"] = "orthotropic";
    changed["first"] = orthotropic->first;
    changed["second"] = orthotropic->second;
    changed["angle"] = degreesText(orthotropic->angle);
  } else {
    changed["type"] = "curve";
    changed["points"] = Json::array();
    for (const cloth::DirectionLimit& point : std::get<cloth::LimitCurve>(limit).points())
      changed["points"].push_back({{"angle", degreesText(point.angle)}, {"stretch", point.stretch}});
    changed["constraints"] = methodNames[static_cast<std::size_t>(choice.method)];
    changed["count"] = choice.count;
  }
  if (changed["type"] != "curve" && choice.method == ConstraintMethod::directions) changed["directions"] = choice.count;
  return changed;
}

Json newEntry(const Json& elements) {
  Json entry{{"name", "limit"}};
  for (const Json& element : elements) {
    const std::string type = element.value("type", "");
    if (elements.size() < 2 || (type != "shell" && type != "membrane")) continue;
    entry["element"] = element["name"];
    break;
  }
  return entry;
}

cloth::LimitConstraints constraintsOf(const cloth::StretchLimit& limit, const ConstraintChoice& choice) {
  const bool curve = std::holds_alternative<cloth::LimitCurve>(limit);
  if (!curve && choice.method != ConstraintMethod::directions) return cloth::exactConstraints(limit);
  switch (choice.method) {
    case ConstraintMethod::ellipses: return cloth::ellipseConstraints(limit, choice.count);
    case ConstraintMethod::directions: return cloth::directionConstraints(limit, choice.count);
    case ConstraintMethod::automatic: break;
  }
  return cloth::limitConstraints(limit, choice.count);
}

}  // namespace pliant::panels
