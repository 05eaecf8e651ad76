#pragma once

#include <limits>

#include "ui/render/points.hpp"

namespace pliant::render {

/// Both ends of a box around columns.
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void add(const Points& points) {
    if (points.cols() == 0) return;
    low = low.cwiseMin(points.rowwise().minCoeff());
    high = high.cwiseMax(points.rowwise().maxCoeff());
  }
  Points corners() const {
    Points places = Points::Zero(3, 8);
    for (int i = 0; i < 8 && low[0] <= high[0]; ++i)
      for (int axis = 0; axis < 3; ++axis) places(axis, i) = (i >> axis) & 1 ? high[axis] : low[axis];
    return places;
  }
};

}  // namespace pliant::render
