#include <algorithm>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

std::vector<MeshEdge> meshEdges(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::pair<std::array<int, 2>, int>> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(t)});
    }
  std::sort(sides.begin(), sides.end());
  std::vector<MeshEdge> edges;
  for (const auto& [nodes, triangle] : sides) {
    if (edges.empty() || edges.back().nodes != nodes) {
      edges.push_back({nodes, {triangle, -1}});
    } else if (edges.back().triangles[1] < 0) {
      edges.back().triangles[1] = triangle;
    } else {
      throw base::InputError("", "triangle " + std::to_string(triangle) + " is the third on the edge between points " +
                                     std::to_string(nodes[0]) + " and " + std::to_string(nodes[1]) +
                                     ", but an edge may have two at most");
    }
  }
  return edges;
}

}  // namespace pliant::geometry
