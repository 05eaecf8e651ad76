#pragma once

#include "core/mechanics/contact_barrier.hpp"

namespace pliant::mechanics {

inline constexpr ContactOptions options{.range = 0.1, .stiffness = 5};

/// A triangle of deformable nodes 0 to 2 and a point 3 above its inside; `body` is that of the point.
inline ContactGeometry triangleAndPoint(int body, double radius = 0) {
  return {.triangles = {{0, 1, 2}}, .edges = {}, .points = {3}, .radii = {0, 0, 0, radius}, .bodies = {0, 0, 0, body}};
}

inline Eigen::Matrix3Xd triangleAndPointAt(const Eigen::Vector3d& point) {
  Eigen::Matrix3Xd x(3, 4);
  x << 0, 1, 0, point.x(), 0, 0, 1, point.y(), 0, 0, 0, point.z();
  return x;
}

}  // namespace pliant::mechanics
