#include "core/geometry/triangle_intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/geometry/box_tree.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;

/// Whether the segment from 0 to q and the triangle have no common point along the axis, whatever the rounding: each
/// projection is a sum of three products, with a relative error of at most three roundings, and the coordinates
/// themselves, which are differences, of one.
bool separates(const Vector3d& axis, const Vector3d& q, const std::array<Vector3d, 3>& triangle) {
  const auto magnitude = [&](const Vector3d& point) { return axis.cwiseAbs().dot(point.cwiseAbs()); };
  const double end = axis.dot(q), low = std::min(0.0, end), high = std::max(0.0, end);
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, error = magnitude(q);
  for (const Vector3d& corner : triangle) {
    const double place = axis.dot(corner);
    lowest = std::min(lowest, place);
    highest = std::max(highest, place);
    error = std::max(error, magnitude(corner));
  }
  error *= 16 * std::numeric_limits<double>::epsilon();
  return lowest - high > error || low - highest > error;
}

}  // namespace

bool segmentMeetsTriangle(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b,
                          const Vector3d& c) {
  // Any axis that separates proves that they do not meet, so rounding in the axes themselves does no harm. For two
  // convex sets the normals of faces and the products of edges are enough; a triangle is a flat prism, whose side faces
  // have the normals n × side.
  const Vector3d end = q - p;
  const std::array<Vector3d, 3> triangle = {a - p, b - p, c - p};
  const std::array<Vector3d, 3> sides = {b - a, c - b, a - c};
  const Vector3d normal = sides[0].cross(sides[1]);
  if (separates(normal, end, triangle) || separates(normal.cross(end), end, triangle)) return false;
  for (const Vector3d& side : sides)
    if (separates(end.cross(side), end, triangle) || separates(normal.cross(side), end, triangle)) return false;
  // Without an area or a length there is less to take directions from: lines, their common normals, points.
  for (int i = 0; i < 3; ++i) {
    const Vector3d &side = sides[i], &corner = triangle[i], across = end.cross(side);
    for (const Vector3d& axis : {side, Vector3d(across.cross(side)), Vector3d(across.cross(end)),
                                 Vector3d(corner.cross(side).cross(side)), Vector3d(corner.cross(end).cross(end))})
      if (separates(axis, end, triangle)) return false;
  }
  return !separates(end, end, triangle) && !separates(triangle[0], end, triangle);
}

std::vector<EdgeTriangleIntersection> findIntersections(const Eigen::Matrix3Xd& points,
                                                        const std::vector<std::array<int, 3>>& triangles,
                                                        const std::vector<std::array<int, 2>>& moreEdges) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(3 * triangles.size() + moreEdges.size());
  for (const auto& triangle : triangles)
    for (int i = 0; i < 3; ++i) {
      const int from = triangle[i], to = triangle[(i + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  edges.insert(edges.end(), moreEdges.begin(), moreEdges.end());

  const auto boxesOf = [&](const auto& simplices) {
    std::vector<BoxTree::Box> boxes(simplices.size());
    for (std::size_t i = 0; i < simplices.size(); ++i)
      for (const int node : simplices[i]) boxes[i].extend(points.col(node));
    return boxes;
  };
  const BoxTree edgeTree(boxesOf(edges)), triangleTree(boxesOf(triangles));
  auto pairs = edgeTree.pairsWith(triangleTree, [&](int e, int t) {
    for (const int node : edges[e])
      if (std::find(triangles[t].begin(), triangles[t].end(), node) != triangles[t].end()) return false;
    const auto& [a, b, c] = triangles[t];
    return segmentMeetsTriangle(
        points.col(edges[e][0]), points.col(edges[e][1]), points.col(a), points.col(b), points.col(c));
  });
  std::sort(pairs.begin(), pairs.end());
  std::vector<EdgeTriangleIntersection> found;
  for (const auto& [e, t] : pairs) found.push_back({edges[e], triangles[t]});
  return found;
}

}  // namespace pliant::geometry
