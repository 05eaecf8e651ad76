#pragma once

#include <string>

#include "ui/render/points.hpp"

namespace pliant::render {

/// A closed path that a node is to run along, as it is drawn.
struct TargetCurve {
  Points curve{3, 0};    ///< in order, the first follows the last [m]
  Points handles{3, 0};  ///< points that can be dragged
  int active = -1;       ///< of them, under the mouse
  std::string label;
};

}  // namespace pliant::render
