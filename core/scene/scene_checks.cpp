#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/normalize.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

std::string at(const char* list, std::size_t index) { return childPointer("/" + std::string(list), index); }

void checkMasses(Json& scene) {
  for (std::size_t i = 0; i < scene["point_masses"].size(); ++i) {
    Json& entry = scene["point_masses"][i];
    const double mass = entry["mass"];
    if (!entry.contains("maximum")) {
      if (mass == 0) throw InputError(at("point_masses", i) + "/maximum", "This key is missing; a mass of 0 needs it.");
      entry["maximum"] = 5 * mass;
    }
    const double minimum = entry["minimum"], maximum = entry["maximum"];
    const auto show = [](double value) { return base::formatQuantityExactly(value, base::dimensions::mass); };
    if (!(minimum < maximum))
      throw InputError(at("point_masses", i) + "/maximum",
                       "The largest mass, " + show(maximum) + ", is not above the smallest, " + show(minimum) + ".");
    if (mass < minimum || mass > maximum)
      throw InputError(at("point_masses", i) + "/mass", "The mass, " + show(mass) +
                                                            ", does not lie between its bounds, " + show(minimum) +
                                                            " and " + show(maximum) + ".");
  }
}

void checkNotZero(const Json& vector, const std::string& pointer) {
  if (std::all_of(vector.begin(), vector.end(), [](const Json& c) { return c.get<double>() == 0; }))
    throw InputError(pointer, "A direction must not be zero.");
}

/// Axes of turns and materials' directions, and keyframes in the order of time.
void checkClothEntries(const Json& scene) {
  for (const char* list : {"boundary_conditions", "bodies"})
    for (std::size_t i = 0; i < scene[list].size(); ++i) {
      const Json path = scene[list][i].value("path", Json::array());
      for (std::size_t k = 0; k < path.size(); ++k) {
        const std::string place = childPointer(at(list, i) + "/path", k);
        checkNotZero(path[k]["axis"], place + "/axis");
        if (k > 0 && !(path[k]["time"] > path[k - 1]["time"]))
          throw InputError(place + "/time", "Keyframes must ascend in time.");
      }
      if (scene[list][i].contains("rotation"))
        checkNotZero(scene[list][i]["rotation"]["axis"], at(list, i) + "/rotation/axis");
    }
  for (std::size_t i = 0; i < scene["stretch_limits"].size(); ++i)
    checkNotZero(scene["stretch_limits"][i]["direction"], at("stretch_limits", i) + "/direction");
}

void checkDirections(const Json& scene) {
  for (const char* list : {"springs", "drives", "loads"})
    for (std::size_t i = 0; i < scene[list].size(); ++i)
      for (const char* key : {"direction", "axis"})
        if (scene[list][i].contains(key)) checkNotZero(scene[list][i][key], at(list, i) + "/" + key);
  for (std::size_t i = 0; i < scene["geometry"].size(); ++i)
    if (scene["geometry"][i].contains("rotation"))
      checkNotZero(scene["geometry"][i]["rotation"]["axis"], at("geometry", i) + "/rotation/axis");
}

void checkDimension(const Json& scene) {
  const int dimension = scene["dimension"];
  const std::string because = " because the scene's dimension is " + std::to_string(dimension) + ".";
  for (std::size_t i = 0; i < scene["geometry"].size(); ++i)
    if (const Json& type = scene["geometry"][i]["type"]; dimension == 1 && type != "points")
      throw InputError(at("geometry", i) + "/type", "Only \"points\" is possible" + because);
    else if (dimension == 2 && type == "blocks")
      throw InputError(at("geometry", i) + "/type", "Blocks are not possible" + because);
  for (std::size_t i = 0; i < scene["elements"].size(); ++i)
    if (const Json& type = scene["elements"][i]["type"];
        dimension < 3 && type != "membrane" && type != "link" && type != "rigid_angle")
      throw InputError(
          at("elements", i) + "/type", "Only \"membrane\", \"link\" and \"rigid_angle\" are possible" + because);
  for (std::size_t i = 0; i < scene["springs"].size(); ++i)
    if (dimension != 2 && scene["springs"][i]["type"] == "torsion")
      throw InputError(at("springs", i) + "/type", "A torsion spring is not possible" + because);
  for (std::size_t i = 0; i < scene["drives"].size(); ++i)
    if (dimension == 1 && scene["drives"][i]["type"] != "translation")
      throw InputError(at("drives", i) + "/type", "Only a translation is possible" + because);
  for (std::size_t i = 0; i < scene["boundary_conditions"].size(); ++i) {
    const Json& entry = scene["boundary_conditions"][i];
    if (dimension != 3 && entry["type"] == "pin")
      throw InputError(at("boundary_conditions", i) + "/type", "A pin is not possible" + because);
    if (!entry.contains("coordinates")) continue;
    for (std::size_t c = 0; c < entry["coordinates"].size(); ++c)
      if (entry["coordinates"][c].get_ref<const std::string&>()[0] - 'x' >= dimension)
        throw InputError(
            childPointer(at("boundary_conditions", i) + "/coordinates", c), "There is no such coordinate" + because);
  }
}

void checkStudies(const Json& scene) {
  for (std::size_t i = 0; i < scene["studies"].size(); ++i) {
    const Json& study = scene["studies"][i];
    const int harmonics = study.value("harmonics", 0), samples = study.value("samples", 1);
    if (samples < 2 * harmonics + 1)
      throw InputError(at("studies", i) + "/samples", "Expected at least " + std::to_string(2 * harmonics + 1) +
                                                          " samples for " + std::to_string(harmonics) +
                                                          " harmonics, found " + std::to_string(samples) + ".");
    if (study.contains("from") && study["from"] == study["to"])
      throw InputError(at("studies", i) + "/to", "The curve must end at another frequency than it starts from.");
    if (study.contains("harmonics_tolerance") && study["maximum_harmonics"] < study["harmonics"])
      throw InputError(at("studies", i) + "/maximum_harmonics",
                       "Expected at least as many as \"harmonics\", " + std::to_string(harmonics) + ".");
  }
}

void checkExpected(const Json& scene) {
  for (std::size_t i = 0; i < scene["expected"].size(); ++i) {
    const auto& pointer = scene["expected"][i]["pointer"].get_ref<const std::string&>();
    try {
      static_cast<void>(Json::json_pointer(pointer));
    } catch (const Json::parse_error&) {
      throw InputError(at("expected", i) + "/pointer", quote(pointer) + " is no JSON pointer; it starts with \"/\".");
    }
  }
}

}  // namespace

void checkScene(Json& normalized) {
  checkMasses(normalized);
  checkDirections(normalized);
  checkClothEntries(normalized);
  checkDimension(normalized);
  checkStudies(normalized);
  checkExpected(normalized);
}

}  // namespace pliant::scene
