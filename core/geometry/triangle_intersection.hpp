#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace pliant::geometry {

/// Whether the segment from p to q has a point in common with the triangle of a, b and c [m]. False is certain: some
/// direction separates the two by more than the rounding errors of all sums involved. True means that they cross or
/// touch, or are so near (about 10⁻¹⁵ of their distances from p) that rounding hides which. Works for degenerate and
/// coplanar ones as well.
bool segmentMeetsTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, const Eigen::Vector3d& c);

struct EdgeTriangleIntersection {
  std::array<int, 2> edge;      ///< its nodes
  std::array<int, 3> triangle;  ///< its nodes
};

/// All pairs of an edge (a side of a triangle, or one of `moreEdges`) and a triangle that meet and share no node.
/// `points` is 3 x n [m]. Sorted by the places in the lists of edges and triangles, sides first.
std::vector<EdgeTriangleIntersection> findIntersections(const Eigen::Matrix3Xd& points,
                                                        const std::vector<std::array<int, 3>>& triangles,
                                                        const std::vector<std::array<int, 2>>& moreEdges = {});

}  // namespace pliant::geometry
