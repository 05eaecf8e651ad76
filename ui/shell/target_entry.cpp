#include "ui/shell/target_entry.hpp"

#include <QCoreApplication>
#include <numbers>

#include "core/scene/json_text.hpp"

namespace pliant::shell {

using scene::Json;

namespace {

QString sentence(const char* text) { return QCoreApplication::translate("pliant::shell::TargetLink", text); }

TargetEntry newStudy(const scene::Scene& scene, const Json& objective, double omega) {
  Json studies = scene.json().value("studies", Json::array());
  double frequency = omega > 0 ? omega : 2 * std::numbers::pi;
  if (!(omega > 0))
    for (const Json& study : scene.normalized().at("studies"))
      if (study.contains("frequency")) {
        frequency = study["frequency"];
        break;
      }
  std::string name = "design";
  for (const Json& study : studies)
    if (study.value("name", "") == name) name += " of a path";
  studies.push_back(
      {{"name", name}, {"type", "design"}, {"frequency", frequency}, {"objectives", Json::array({objective})}});
  return {"/studies", studies, {}};
}

}  // namespace

TargetEntry targetEntry(const scene::Scene& scene, const std::string& pointer, const Json& path, double omega) {
  if (!pointer.empty()) return {pointer, path, {}};
  const Json objective{{"type", "path"}, {"paths", Json::array({path})}};
  const Json& studies = scene.json().value("studies", Json::array());
  for (std::size_t i = 0; i < studies.size(); ++i) {
    if (studies[i].value("type", "") != "design") continue;
    Json objectives = Json::array();
    bool dropped = false, joined = false;
    for (Json other : studies[i].value("objectives", Json::array())) {
      const std::string type = other.value("type", "");
      if (type == "amplitude") {
        dropped = true;
        continue;
      }
      // Paths of one objective have one phase.
      if (type == "path" && !joined) {
        other["paths"].push_back(path);
        joined = true;
      }
      objectives.push_back(std::move(other));
    }
    if (!joined) objectives.push_back(objective);
    return {scene::childPointer("/studies", i) + "/objectives", objectives,
            dropped
                ? sentence("The design now follows the target path in the place of amplitudes; undo brings these back.")
                : QString()};
  }
  return newStudy(scene, objective, omega);
}

}  // namespace pliant::shell
