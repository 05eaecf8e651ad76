#include "core/scene/parts_request.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace pliant::scene {

namespace dimensions = base::dimensions;

const std::vector<PartsNumber>& partsNumbers() {
  static const std::vector<PartsNumber> numbers{
      {"thickness", "Thickness of links", "Thickness of links", dimensions::length, "mm", &PartsRequest::thickness,
       true, false, false},
      {"width", "Width of links", "Width of links", dimensions::length, "mm", &PartsRequest::width, true, false, false},
      {"hole", "Holes at joints", "Diameter of the holes at joints", dimensions::length, "mm", &PartsRequest::hole,
       true, false, false},
      {"spring-hole", "Holes for springs", "Diameter of the holes where springs are attached", dimensions::length, "mm",
       &PartsRequest::springHole, true, false, false},
      {"clearance", "Clearance", "Between links on top of one another, and around balls in sockets", dimensions::length,
       "mm", &PartsRequest::clearance, true, true, false},
      {"wall", "Wall of sockets", "Thickness of the sockets that hold balls", dimensions::length, "mm",
       &PartsRequest::wall, false, true, false},
      {"density", "Density of masses", "Of the balls and cylinders that masses become; brass", dimensions::density,
       "g/cm^3", &PartsRequest::density, false, true, true},
      {"cylinder-height", "Height of cylinders", "Of the cylinders in the table of parameters", dimensions::length,
       "mm", &PartsRequest::cylinderHeight, false, false, true},
      {"tolerance", "Tolerance", "How far chords may lie from round surfaces", dimensions::length, "mm",
       &PartsRequest::tolerance, true, true, false}};
  return numbers;
}

bool hasElements(const Scene& scene, std::string_view type) {
  const Json& elements = scene.normalized()["elements"];
  return std::any_of(elements.begin(), elements.end(), [&](const Json& element) { return element["type"] == type; });
}

double inOwnUnit(const PartsRequest& request, const PartsNumber& number) {
  return request.*number.value / base::parseQuantity(std::string("1 ") + number.unit, number.dimension);
}

void checkRequest(const PartsRequest& request) {
  for (const PartsNumber& number : partsNumbers())
    if (const double value = request.*number.value; !(value > 0) || !std::isfinite(value))
      throw base::InputError(number.key, "Expected a number above 0.");
  for (const auto& [key, hole] : {std::pair{"hole", request.hole}, std::pair{"spring-hole", request.springHole}})
    if (!(hole < request.width))
      throw base::InputError(key, "A hole of " + base::formatQuantity(hole, dimensions::length) +
                                      " does not fit into a link that is " +
                                      base::formatQuantity(request.width, dimensions::length) + " wide.");
}

}  // namespace pliant::scene
