#pragma once

#include "core/interlock/part_distance.hpp"

namespace pliant::interlock {

/// Where on two parts their closest points are.
struct ArcPlaces {
  double parameterA = 0, parameterB = 0;              ///< of those that are arcs
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of the corners of the one that is a simplex
  /// For each free parameter of ClosestArcs that belongs to a simplex: its tangent is corners * this.
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
};

/// As closestArcs(a, b, offset), which also tells the places.
ClosestArcs closestArcs(const PlacedPart& a, const PlacedPart& b, const Eigen::Vector3d& offset, ArcPlaces& places);

}  // namespace pliant::interlock
