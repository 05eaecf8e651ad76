#include "core/interlock/sphere_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::interlock {

using Eigen::Vector3d;

std::vector<std::array<int, 2>> edgesOf(const SphereMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      if (from < to) edges.push_back({from, to});  // the other triangle has it the other way round
  std::sort(edges.begin(), edges.end());
  return edges;
}

SphereMesh refined(const SphereMesh& mesh, const std::vector<std::array<int, 2>>& edges) {
  SphereMesh result{mesh.directions, {}, mesh.parents};
  std::map<std::array<int, 2>, int> middles;
  for (const auto& edge : edges) middles.emplace(edge, -1);
  for (auto& [edge, middle] : middles) {
    middle = static_cast<int>(result.directions.size());
    result.directions.push_back((mesh.directions[edge[0]] + mesh.directions[edge[1]]).normalized());
    result.parents.push_back(edge);
  }
  const auto middleOf = [&](int a, int b) {
    const auto found = middles.find({std::min(a, b), std::max(a, b)});
    return found == middles.end() ? -1 : found->second;
  };
  for (std::array<int, 3> corners : mesh.triangles) {
    std::array<int, 3> cut;
    const auto findCuts = [&] {
      for (int i = 0; i < 3; ++i) cut[i] = middleOf(corners[i], corners[(i + 1) % 3]);
      return static_cast<int>(std::count_if(cut.begin(), cut.end(), [](int middle) { return middle >= 0; }));
    };
    const int count = findCuts();
    // Turned so that a single cut is on the first edge, and a single whole edge is the last.
    const auto turn = [&] { std::rotate(corners.begin(), corners.begin() + 1, corners.end()), findCuts(); };
    while ((count == 1 && cut[0] < 0) || (count == 2 && cut[2] >= 0)) turn();
    const auto [a, b, c] = corners;
    auto& triangles = result.triangles;
    if (count == 0) triangles.push_back(corners);
    if (count == 1) triangles.insert(triangles.end(), {{a, cut[0], c}, {cut[0], b, c}});
    if (count == 2) triangles.insert(triangles.end(), {{cut[0], b, cut[1]}, {a, cut[0], cut[1]}, {a, cut[1], c}});
    if (count == 3)
      triangles.insert(
          triangles.end(), {{a, cut[0], cut[2]}, {cut[0], b, cut[1]}, {cut[2], cut[1], c}, {cut[0], cut[1], cut[2]}});
  }
  return result;
}

SphereMesh icosphere(int subdivisions) {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  SphereMesh mesh;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-golden, golden}) {
      mesh.directions.push_back(Vector3d(x, y, 0).normalized());
      mesh.directions.push_back(Vector3d(0, x, y).normalized());
      mesh.directions.push_back(Vector3d(y, 0, x).normalized());
    }
  mesh.parents.assign(mesh.directions.size(), {-1, -1});
  // Three corners that are neighbours of each other.
  const auto near = [&](int i, int j) { return mesh.directions[i].dot(mesh.directions[j]) > 0.4; };
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        Eigen::Matrix3d corners;
        corners << mesh.directions[a], mesh.directions[b], mesh.directions[c];
        const double volume =
            corners.col(0).dot(Vector3d(corners(1, 1) * corners(2, 2) - corners(2, 1) * corners(1, 2),
                                        corners(2, 1) * corners(0, 2) - corners(0, 1) * corners(2, 2),
                                        corners(0, 1) * corners(1, 2) - corners(1, 1) * corners(0, 2)));
        mesh.triangles.push_back(volume > 0 ? std::array{a, b, c} : std::array{a, c, b});
      }
  for (int i = 0; i < subdivisions; ++i) mesh = refined(mesh, edgesOf(mesh));
  return mesh;
}

}  // namespace pliant::interlock
