#pragma once

#include <vector>

#include "core/interlock/element_parts.hpp"
#include "core/interlock/part_distance.hpp"

namespace pliant::interlock {

/// An element in space, with all of its parts turned.
struct ElementPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< of its origin [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< from its coordinates
  std::vector<ClosedCurve> curves;                         ///< turned, not moved
  Eigen::Matrix3Xd corners, centres;                       ///< the same: corners, and balls' centres

  ElementPose() = default;
  ElementPose(const ElementParts& parts, const Eigen::Vector3d& place, const Eigen::Matrix3d& turn);
  PlacedPart part(const ElementParts& parts, int number) const;
};

/// Appends all pairs of parts of two elements, one of each, with a gap below `reach` [m], and some others.
void appendNearParts(const ElementParts& first, const Eigen::Matrix3Xd& firstCentres, const ElementParts& second,
                     const Eigen::Matrix3Xd& secondCentres, const Eigen::Vector3d& offset, double reach,
                     std::vector<std::array<int, 2>>& pairs);

}  // namespace pliant::interlock
