#include "ui/document/study_state.hpp"

#include <algorithm>
#include <array>

namespace pliant::document {

namespace {

using scene::Json;

/// What only studies of cloth read.
constexpr std::array<const char*, 3> keysOfCloth = {"stretch_limits", "bodies", "contact"};
constexpr std::array<std::string_view, 8> keysThatDoNotMatter = {
    "schema_version", "title", "description", "studies", "expected", keysOfCloth[0], keysOfCloth[1], keysOfCloth[2]};

bool sameCloth(const Json& a, const Json& b) {
  return std::all_of(keysOfCloth.begin(), keysOfCloth.end(),
                     [&](const char* key) { return a.value(key, Json()) == b.value(key, Json()); });
}

const Json* findStudy(const scene::Scene& scene, const std::string& name) {
  const Json& all = scene.normalized();
  const auto studies = all.find("studies");
  if (studies == all.end()) return nullptr;
  for (const Json& study : *studies)
    if (study.value("name", "") == name) return &study;
  return nullptr;
}

}  // namespace

bool mattersToModel(const std::string& pointer) {
  const std::string key = pointer.substr(0, pointer.find('/', 1));
  return std::none_of(keysThatDoNotMatter.begin(), keysThatDoNotMatter.end(),
                      [&](std::string_view other) { return key.size() == other.size() + 1 && key.ends_with(other); });
}

bool sameModel(const Json& a, const Json& b) {
  if (&a == &b) return true;
  const auto covers = [&](const Json& from, const Json& other) {
    return std::all_of(from.items().begin(), from.items().end(), [&](const auto& item) {
      if (!mattersToModel("/" + item.key())) return true;
      const auto found = other.find(item.key());
      return found != other.end() && *found == item.value();
    });
  };
  return covers(a, b) && covers(b, a);
}

bool sameModel(const scene::Scene& a, const scene::Scene& b) { return sameModel(a.normalized(), b.normalized()); }

bool sameStudy(const scene::Scene& a, const scene::Scene& b, const std::string& study) {
  if (!sameModel(a, b)) return false;
  const Json* first = findStudy(a, study);
  const Json* second = findStudy(b, study);
  if (!first || !second || *first != *second) return false;
  return !isClothStudy(first->value("type", "")) || sameCloth(a.normalized(), b.normalized());
}

bool isClothStudy(const std::string& type) {
  return type == "cloth_motion" || type == "cloth_drape" || type == "projection";
}

QString toString(StudyStatus status) {
  switch (status) {
    case StudyStatus::none: return QStringLiteral("not run");
    case StudyStatus::waiting: return QStringLiteral("waiting");
    case StudyStatus::running: return QStringLiteral("running");
    case StudyStatus::solved: return QStringLiteral("solved");
    case StudyStatus::stale: return QStringLiteral("stale");
    case StudyStatus::cancelled: return QStringLiteral("cancelled");
    case StudyStatus::failed: return QStringLiteral("failed");
  }
  return {};
}

}  // namespace pliant::document
