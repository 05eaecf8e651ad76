#pragma once

#include <functional>
#include <random>

#include "core/geometry/simplex_distance.hpp"

namespace pliant::geometry {

/// In the cube from -1 to 1.
inline Corners randomCorners(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  return Corners::NullaryExpr([&] { return coordinate(random); });
}

/// Central differences.
inline CornerVector gradientByDifferences(const std::function<double(const Corners&)>& value, const Corners& corners,
                                          double step) {
  CornerVector gradient;
  for (int i = 0; i < 12; ++i) {
    Corners up = corners, down = corners;
    up.reshaped()[i] += step;
    down.reshaped()[i] -= step;
    gradient[i] = (value(up) - value(down)) / (2 * step);
  }
  return gradient;
}

inline CornerMatrix hessianByDifferences(const std::function<CornerVector(const Corners&)>& gradient,
                                         const Corners& corners, double step) {
  CornerMatrix hessian;
  for (int i = 0; i < 12; ++i) {
    Corners up = corners, down = corners;
    up.reshaped()[i] += step;
    down.reshaped()[i] -= step;
    hessian.col(i) = (gradient(up) - gradient(down)) / (2 * step);
  }
  return hessian;
}

}  // namespace pliant::geometry
