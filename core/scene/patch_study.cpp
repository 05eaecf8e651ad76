#include "core/scene/patch_study.hpp"

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/scene/input_error_location.hpp"

namespace pliant::scene {

namespace {

/// Place of a study in its scene.
std::string pointerOfStudy(const Scene& scene, const Json& options) {
  const Json& studies = scene.normalized()["studies"];
  std::size_t index = 0;
  while (studies[index]["name"] != options["name"]) ++index;
  return "/studies/" + std::to_string(index);
}

}  // namespace

interlock::PatchOutline patchOutline(const Json& options) {
  interlock::PatchOutline outline;
  outline.centre = {options.at("centre").at(0).get<double>(), options.at("centre").at(1).get<double>()};
  if (options.contains("radius") == options.contains("size"))
    throw base::InputError("", "Either \"radius\" or \"size\" tells which elements belong to the patch.");
  if (options.contains("radius")) {
    outline.radius = options.at("radius");
  } else {
    outline.kind = interlock::PatchOutline::Kind::rectangle;
    outline.size = {options.at("size").at(0).get<double>(), options.at("size").at(1).get<double>()};
  }
  return outline;
}

std::vector<int> clampedElements(const interlock::UnitCell& patch, double direction, double width) {
  const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
  double first = std::numeric_limits<double>::infinity();
  for (const auto& element : patch.elements) first = std::min(first, along.dot(element.position.head<2>()));
  std::vector<int> clamped;
  for (std::size_t i = 0; i < patch.elements.size(); ++i)
    if (along.dot(patch.elements[i].position.head<2>()) <= first + width) clamped.push_back(static_cast<int>(i));
  return clamped;
}

PatchStudy::PatchStudy(const Scene& scene, const Json& options)
    : InterlockStudy(scene, options), place_(scene.name() + ": " + pointerOfStudy(scene, options)) {}

std::shared_ptr<const interlock::UnitCell> PatchStudy::cut(const interlock::PatchOutline& outline) const {
  return locate(place_, [&] { return std::make_shared<const interlock::UnitCell>(cutPatch(*cell_, outline)); });
}

std::shared_ptr<const interlock::UnitCell> PatchStudy::cut() const {
  return cut(locate(place_, [&] { return patchOutline(options_); }));
}

interlock::EquilibriumOptions PatchStudy::equilibriumOptions() const {
  interlock::EquilibriumOptions options = InterlockStudy::equilibriumOptions();
  options.looseTolerance = 1;
  options.maximumIterations = 2000;
  return options;
}

interlock::BendingOptions PatchStudy::bendingOptions() const {
  interlock::BendingOptions options;
  if (options_.contains("lateral")) options.lateral = lateral();
  options.increment = options_["increment"];
  options.perturbation = options_["perturbation"];
  options.seed = options_["seed"];
  options.trials = options_["trials"];
  return options;
}

}  // namespace pliant::scene
