#include "core/scene/study_input.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

std::string placeOfStudy(const Scene& scene, const Json& options) {
  const Json& studies = scene.normalized()["studies"];
  std::size_t index = 0;
  while (index < studies.size() && studies[index]["name"] != options["name"]) ++index;
  return scene.name() + ": " + childPointer("/studies", index);
}

int parameterNamed(const mechanics::Model& model, const Json& list, std::size_t entry, const std::string& place) {
  const std::string name = list[entry];
  const auto found = std::find_if(model.parameters.begin(), model.parameters.end(),
                                  [&](const auto& parameter) { return parameter->name() == name; });
  if (found == model.parameters.end())
    throw InputError(
        childPointer(place, entry), "There is no point mass and no entry of \"parameters\" named " + quote(name) + ".");
  const auto end = list.begin() + static_cast<std::ptrdiff_t>(entry);
  if (std::find(list.begin(), end, name) != end)
    throw InputError(childPointer(place, entry), "The parameter " + quote(name) + " stands twice in this list.");
  return static_cast<int>(found - model.parameters.begin());
}

}  // namespace pliant::scene
