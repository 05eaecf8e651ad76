#include "ui/jobs/comparable_scenes.hpp"

#include "core/mechanics/design_parameter.hpp"
#include "ui/document/study_state.hpp"

namespace pliant::jobs {

bool areComparable(const scene::Scene& a, const scene::Scene& b, const mechanics::Model& model) {
  scene::Json changed = a.normalized();
  for (const auto& parameter : model.parameters) {
    const std::string pointer = parameter->pointer();
    const scene::Json::json_pointer path(pointer);
    if (!changed.contains(path) || !b.normalized().contains(path)) return false;
    changed[path] = b.normalized().at(path);
    // A bound that the file leaves out follows the mass.
    const scene::Json::json_pointer bound(pointer.substr(0, pointer.rfind('/')) + "/maximum");
    if (!a.json().contains(bound) && !b.json().contains(bound) && b.normalized().contains(bound))
      changed[bound] = b.normalized().at(bound);
  }
  return document::sameModel(changed, b.normalized());
}

}  // namespace pliant::jobs
