#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/geometry/triangle_intersection.hpp"

/// What findIntersections finds, without a hierarchy and by another formula: for each side and triangle without a
/// common node, the signs of volumes in extended precision. Triangles must not be degenerate, and coplanar pairs count
/// as apart.
inline int countIntersectionsByBruteForce(const Eigen::Matrix3Xd& points,
                                          const std::vector<std::array<int, 3>>& triangles) {
  using Point = std::array<long double, 3>;
  const auto difference = [&](int from, int to) {
    Point result;
    for (int i = 0; i < 3; ++i) result[i] = static_cast<long double>(points(i, to)) - points(i, from);
    return result;
  };
  const auto cross = [](const Point& a, const Point& b) {
    return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  std::vector<std::array<int, 2>> edges;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  int count = 0;
  for (const auto& [a, b, c] : triangles) {
    const Point normal = cross(difference(a, b), difference(a, c));
    const Eigen::Array3d low = points.col(a).cwiseMin(points.col(b)).cwiseMin(points.col(c));
    const Eigen::Array3d high = points.col(a).cwiseMax(points.col(b)).cwiseMax(points.col(c));
    for (const auto& [p, q] : edges) {
      const Eigen::Array3d start = points.col(p), end = points.col(q);
      if ((start < low && end < low).any() || (start > high && end > high).any()) continue;  // exact, and saves time
      const long double from = dot(normal, difference(a, p)), to = dot(normal, difference(a, q));
      if ((from > 0 && to > 0) || (from < 0 && to < 0) || (from == 0 && to == 0)) continue;
      if (a == p || b == p || c == p || a == q || b == q || c == q) continue;
      const Point segment = difference(p, q), pa = difference(p, a), pb = difference(p, b), pc = difference(p, c);
      const long double x = dot(segment, cross(pa, pb)), y = dot(segment, cross(pb, pc)),
                        z = dot(segment, cross(pc, pa));
      if ((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0)) ++count;
    }
  }
  return count;
}

/// The smallest distance of a point from the triangles: by the definition, over their insides, sides and corners.
inline double distanceByBruteForce(const Eigen::Matrix3Xd& points, const std::vector<std::array<int, 3>>& triangles,
                                   const Eigen::Vector3d& point) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d a = points.col(triangle[0]);
    Eigen::Matrix<double, 3, 2> sides;
    sides << points.col(triangle[1]) - a, points.col(triangle[2]) - a;
    const Eigen::Vector2d inside = (sides.transpose() * sides).inverse() * (sides.transpose() * (point - a));
    if (inside.minCoeff() >= 0 && inside.sum() <= 1) smallest = std::min(smallest, (a + sides * inside - point).norm());
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d from = points.col(triangle[k]), along = points.col(triangle[(k + 1) % 3]) - from;
      const double t = std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0);
      smallest = std::min(smallest, (from + t * along - point).norm());
    }
  }
  return smallest;
}
