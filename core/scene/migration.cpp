#include "core/scene/migration.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

Json migrate(Json scene, std::span<const MigrationStep> steps, int newest) {
  static const std::string pointer = "/schema_version";
  if (!scene.is_object()) throw InputError("", "A scene is a JSON object, but this is " + describe(scene) + ".");
  if (!scene.contains("schema_version"))
    throw InputError(
        pointer, "This key is missing; a scene of this version of Pliant has " + std::to_string(newest) + ".");
  const Json& found = scene["schema_version"];
  if (!found.is_number_integer()) throw InputError(pointer, "Expected a whole number, found " + describe(found) + ".");
  const auto version = found.get<long long>();
  if (version > newest)
    throw InputError(pointer, "The scene has version " + std::to_string(version) +
                                  ", but this version of Pliant reads " + std::to_string(newest) +
                                  " at most; use a newer Pliant.");
  for (int current = static_cast<int>(std::max(version, -1LL)); current < newest; ++current) {
    const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s.from == current; });
    if (step == steps.end())
      throw InputError(pointer, "There has never been a version " + std::to_string(version) +
                                    " of the format; expected " + std::to_string(newest) + ".");
    step->apply(scene);
    scene["schema_version"] = current + 1;
  }
  return scene;
}

std::span<const MigrationStep> migrationSteps() { return {}; }

}  // namespace pliant::scene
