#include "core/geometry/orientation.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

namespace {

/// Whether the triangle runs along its edge from `nodes[0]` to `nodes[1]`.
bool runsForwards(const std::array<int, 3>& triangle, const std::array<int, 2>& nodes) {
  for (int i = 0; i < 3; ++i)
    if (triangle[i] == nodes[0]) return triangle[(i + 1) % 3] == nodes[1];
  return false;
}

}  // namespace

std::vector<std::array<int, 3>> orientTriangles(std::vector<std::array<int, 3>> triangles) {
  std::vector<std::vector<MeshEdge>> shared(triangles.size());  // per triangle: its edges with a neighbour
  for (const MeshEdge& edge : meshEdges(triangles)) {
    if (edge.triangles[1] < 0) continue;
    for (const int t : edge.triangles) shared[t].push_back(edge);
  }
  std::vector<char> visited(triangles.size(), 0);
  for (std::size_t start = 0; start < triangles.size(); ++start) {
    if (visited[start]) continue;
    visited[start] = 1;
    std::vector<int> front = {static_cast<int>(start)};
    while (!front.empty()) {
      const int t = front.back();
      front.pop_back();
      for (const MeshEdge& edge : shared[t]) {
        const int other = edge.triangles[0] == t ? edge.triangles[1] : edge.triangles[0];
        const bool agrees = runsForwards(triangles[t], edge.nodes) != runsForwards(triangles[other], edge.nodes);
        if (visited[other]) {
          if (!agrees)
            throw base::InputError("", "triangle " + std::to_string(other) +
                                           " cannot be turned to agree with triangle " + std::to_string(t) +
                                           ": the surface is one-sided");
          continue;
        }
        if (!agrees) std::swap(triangles[other][1], triangles[other][2]);
        visited[other] = 1;
        front.push_back(other);
      }
    }
  }
  return triangles;
}

}  // namespace pliant::geometry
