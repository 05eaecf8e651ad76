#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/units.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// How the bodies of a scene are to be made. SI units.
struct PartsRequest {
  double thickness = 3e-3;       ///< of links' plates
  double width = 10e-3;          ///< of links
  double hole = 3e-3;            ///< diameter at joints
  double springHole = 2e-3;      ///< diameter where springs are attached
  double clearance = 2e-4;       ///< between plates, and around balls in sockets
  double wall = 1e-3;            ///< thickness of sockets
  double density = 8500;         ///< of the balls and cylinders that masses become; brass
  double cylinderHeight = 1e-2;  ///< of the cylinders
  double tolerance = 2e-5;       ///< how far chords may lie from round surfaces
  bool flat = false;             ///< links side by side on the ground instead of in layers, as they are mounted
};

/// One number of a request, for the command line and dialogs.
struct PartsNumber {
  const char* key;          ///< such as "spring-hole"
  const char* label;        ///< such as "Hole for a spring"
  const char* description;  ///< one phrase
  base::Dimension dimension;
  const char* unit;  ///< in which people say it
  double PartsRequest::*value;
  bool links, rods, table;  ///< whether it concerns links, rods, and the table of parameters
};
const std::vector<PartsNumber>& partsNumbers();

/// Whether a scene has elements of a type, such as "link".
bool hasElements(const Scene& scene, std::string_view type);

/// A number in its own unit: 3, of 3 mm.
double inOwnUnit(const PartsRequest& request, const PartsNumber& number);

/// Throws base::InputError with the number's key as location unless all are above 0 and holes are smaller than links
/// are wide.
void checkRequest(const PartsRequest& request);

}  // namespace pliant::scene
