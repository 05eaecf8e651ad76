#include "core/scene/scene_parameters.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

/// The lists whose numbers shape the model.
bool shapesTheModel(const std::string& pointer) {
  for (const char* list : {"/geometry/", "/materials/", "/elements/", "/springs/", "/drives/", "/loads/", "/damping/"})
    if (pointer.starts_with(list)) return true;
  return false;
}

/// Whether a pointer is that of a study's own frequency.
bool isFrequencyOfStudy(const std::string& pointer) {
  return pointer.starts_with("/studies/") && pointer.ends_with("/frequency") &&
         std::count(pointer.begin(), pointer.end(), '/') == 3;
}

/// The entry's value in SI, with its bounds: as given, or half and twice the value.
mechanics::FamilyParameter declare(const Scene& scene, const Json& entry, const std::string& place) {
  mechanics::FamilyParameter parameter;
  parameter.name = entry["name"];
  parameter.pointer = entry["pointer"];
  const base::ParameterSpec* spec = locate(place + "/pointer", [&] { return specAt(scene, parameter.pointer); });
  const auto path = Json::json_pointer(parameter.pointer);
  const bool isNumber = spec && spec->kind == base::ValueKind::number && scene.normalized().contains(path);
  if (!isNumber || !(shapesTheModel(parameter.pointer) || isFrequencyOfStudy(parameter.pointer)))
    throw InputError(place + "/pointer", quote(parameter.pointer) +
                                             " names no number of a geometry, material, element, spring, drive, load "
                                             "or the damping, nor the frequency of a study (masses are parameters of "
                                             "their own).");
  parameter.dimension = spec->dimension;
  const double value = scene.normalized()[path];
  parameter.minimum = entry.value("minimum", std::min(value / 2, value * 2));
  parameter.maximum = entry.value("maximum", std::max(value / 2, value * 2));
  if (!(parameter.minimum < parameter.maximum))
    throw InputError(
        place + "/maximum", "The maximum must be above the minimum; where the value is 0 both are needed.");
  if (value < parameter.minimum || value > parameter.maximum)
    throw InputError(
        place, "The value at " + quote(parameter.pointer) + " is not between the minimum and the maximum.");
  return parameter;
}

}  // namespace

void addSceneParameters(const Scene& scene, mechanics::Model& model, mechanics::Model (*build)(const Scene&)) {
  const Json& entries = scene.normalized()["parameters"];
  if (entries.empty()) return;
  std::vector<mechanics::FamilyParameter> declared;
  std::vector<std::string> pointers;  // of the family
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string place = childPointer("/parameters", i);
    mechanics::FamilyParameter parameter = declare(scene, entries[i], place);
    const std::string& pointer = parameter.pointer;
    if (std::any_of(declared.begin(), declared.end(), [&](const auto& other) { return other.pointer == pointer; }))
      throw InputError(place + "/pointer", "There is already a parameter for " + quote(pointer) + ".");
    if (!isFrequencyOfStudy(pointer))
      pointers.push_back(pointer);
    else if (!(parameter.minimum > 0))
      throw InputError(place + "/minimum", "A frequency must be above 0.");
    declared.push_back(std::move(parameter));
  }
  const auto family =
      std::make_shared<const mechanics::ModelFamily>([scene, pointers, build](const std::vector<double>& values) {
        mechanics::Model member = build(scene.withNumbers(pointers, values));
        member.familyValues = values;
        return member;
      });
  for (mechanics::FamilyParameter& parameter : declared) {
    const double value = scene.normalized()[Json::json_pointer(parameter.pointer)];
    if (isFrequencyOfStudy(parameter.pointer)) {
      model.parameters.push_back(mechanics::makeDriveFrequency(
          {parameter.name, parameter.pointer, value, parameter.minimum, parameter.maximum}));
      continue;
    }
    const auto index = static_cast<int>(model.familyValues.size());
    model.familyValues.push_back(value);
    model.parameters.push_back(mechanics::makeFamilyParameter(index, std::move(parameter), family));
  }
}

}  // namespace pliant::scene
