#include "ui/document/relocation.hpp"

#include <vector>

namespace pliant::document {

namespace {

using scene::Json;

void collectPaths(const scene::Scene& scene, const Json& value, const std::string& pointer,
                  std::vector<std::string>& found) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.items()) collectPaths(scene, child, pointer + "/" + key, found);
  } else if (value.is_array() && !value.empty() && !value.front().is_number()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      collectPaths(scene, value[i], pointer + "/" + std::to_string(i), found);
  } else if (value.is_string()) {
    const base::ParameterSpec* spec = scene::specAt(scene, pointer);
    if (spec && spec->kind == base::ValueKind::path) found.push_back(pointer);
  }
}

}  // namespace

scene::Scene relocated(const scene::Scene& scene, const std::filesystem::path& directory) {
  const auto from = std::filesystem::weakly_canonical(scene.directory());
  const auto to = std::filesystem::weakly_canonical(directory);
  if (from == to) return scene;
  std::vector<std::string> pointers;
  collectPaths(scene, scene.json(), "", pointers);
  Json text = scene.json();
  for (const std::string& pointer : pointers) {
    Json& value = text.at(Json::json_pointer(pointer));
    const std::filesystem::path path = value.get<std::string>();
    if (path.is_relative()) value = (from / path).lexically_relative(to).generic_string();
  }
  return scene::Scene::parse(text.dump(), to, scene.name());
}

}  // namespace pliant::document
