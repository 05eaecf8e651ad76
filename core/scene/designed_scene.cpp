#include "core/scene/designed_scene.hpp"

#include <map>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"

namespace pliant::scene {

namespace {

using Pointer = Json::json_pointer;

/// Lists whose entries are designed one by one may be left out of a scene as long as all entries are alike: those are
/// put there, as long as the design needs them.
void addMissingList(const Pointer& list, std::size_t count, const Json& normalized, Json& json) {
  const auto isThere = [&](const Json& from) { return from.contains(list) && !from[list].empty(); };
  if (isThere(json)) return;
  json[list] = isThere(normalized) ? normalized[list] : Json(std::vector<double>(count, 1.0));
}

}  // namespace

Json sceneWithValues(const Scene& scene, const mechanics::Model& model, const std::vector<int>& parameters,
                     const mechanics::Vector& values) {
  Json json = scene.json();
  std::map<std::string, std::size_t> listSizes;
  const auto parameterAt = [&](std::size_t i) -> const mechanics::DesignParameter& {
    return *model.parameters[static_cast<std::size_t>(parameters[i])];
  };
  const auto isEntry = [](const Pointer& pointer) {
    return pointer.back().find_first_not_of("0123456789") == std::string::npos;
  };
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (const Pointer pointer(parameterAt(i).pointer()); isEntry(pointer))
      ++listSizes[pointer.parent_pointer().to_string()];
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Pointer pointer(parameterAt(i).pointer());
    if (isEntry(pointer))
      addMissingList(
          pointer.parent_pointer(), listSizes[pointer.parent_pointer().to_string()], scene.normalized(), json);
    if (!json.contains(pointer) && !scene.normalized().contains(pointer))
      throw base::InputError(scene.name() + ": " + pointer.to_string(), "The scene has no such value any more.");
    json[pointer] = values[static_cast<Eigen::Index>(i)];
  }
  return json;
}

Json designedScene(const Scene& scene, const DesignResult& result, const harmonic::DesignIterate& design) {
  return sceneWithValues(scene, *design.model, result.parameters, design.values);
}

}  // namespace pliant::scene
