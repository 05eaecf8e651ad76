#pragma once

namespace pliant::math {

/// Where the driving frequencies are in their periods [rad]: a point of a circle, or of a torus if there are two. A
/// number stands for the phase of the first one where there is no second.
struct Phases {
  double first = 0;
  double second = 0;

  Phases(double first_) : first(first_) {}
  Phases(double first_, double second_) : first(first_), second(second_) {}
};

}  // namespace pliant::math
