#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/triangle_intersection.hpp"

/// What findIntersections finds, without a hierarchy and by another formula: for each side and triangle without a
/// common node, the signs of volumes in extended precision. Triangles must not be degenerate, and coplanar pairs count
/// as apart.
inline int countIntersectionsByBruteForce(const Eigen::Matrix3Xd& points,
                                          const std::vector<std::array<int, 3>>& triangles) {
  using Point = Eigen::Matrix<long double, 3, 1>;
  const auto volume = [&](int a, int b, int c, int d) {
    const Point origin = points.col(a).cast<long double>();
    Eigen::Matrix<long double, 3, 3> m;
    m << points.col(b).cast<long double>() - origin, points.col(c).cast<long double>() - origin,
        points.col(d).cast<long double>() - origin;
    return m.determinant();
  };
  std::vector<std::array<int, 2>> edges;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  int count = 0;
  for (const auto& [p, q] : edges)
    for (const auto& [a, b, c] : triangles) {
      if (a == p || b == p || c == p || a == q || b == q || c == q) continue;
      const long double from = volume(p, a, b, c), to = volume(q, a, b, c);
      if (from * to > 0 || (from == 0 && to == 0)) continue;
      const long double x = volume(p, q, a, b), y = volume(p, q, b, c), z = volume(p, q, c, a);
      if ((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0)) ++count;
    }
  return count;
}
