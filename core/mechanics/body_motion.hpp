#pragma once

#include <Eigen/Core>
#include <vector>

namespace pliant::mechanics {

/// A motion through given displacements and turns, linear in between, at rest before the first and after the last.
struct Keyframe {
  double time = 0;                                        ///< [s]
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< about the body's centre: axis times angle [rad]
};

/// A rigid displacement of what rests around a centre.
struct Placement {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  /// Where `points` (3 x n) that turn about `centre` are [m].
  Eigen::Matrix3Xd apply(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& centre) const;
};

/// Where a path is at `time`: at rest if it has no keyframes; translation and rotation vector are interpolated linearly
/// between keyframes, so that a turn about one axis has a constant rate. Keyframes ascend in time.
Placement placementAt(const std::vector<Keyframe>& path, double time);

}  // namespace pliant::mechanics
