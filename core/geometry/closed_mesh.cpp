#include "core/geometry/closed_mesh.hpp"

#include <Eigen/Geometry>

#include "core/base/error.hpp"

namespace pliant::geometry {

void checkClosed(const SurfaceMesh& mesh) {
  checkMesh(mesh);
  // The edge of each triangle from a to b, with the corner after b: those of one point lead around it.
  std::map<std::array<int, 2>, int> next;
  std::vector<int> fan(mesh.points.cols(), 0), first(mesh.points.cols(), -1);
  const auto between = [](int a, int b) {
    return " between points " + std::to_string(a) + " and " + std::to_string(b);
  };
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to, last] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
      if (!next.emplace(std::array{from, to}, last).second)
        throw base::InputError("", "two triangles run along the edge" + between(from, to) + " in the same direction");
      ++fan[from];
      first[from] = to;
    }
  for (const auto& [edge, last] : next)
    if (!next.count({edge[1], edge[0]}))
      throw base::InputError("", "the surface is open at the edge" + between(edge[0], edge[1]));
  for (std::size_t node = 0; node < fan.size(); ++node) {
    if (fan[node] == 0) continue;
    int count = 0;
    for (int at = first[node]; count == 0 || at != first[node]; ++count) at = next.at({static_cast<int>(node), at});
    if (count != fan[node]) throw base::InputError("", "the surface touches itself at point " + std::to_string(node));
  }
}

double enclosedVolume(const SurfaceMesh& mesh) {
  double volume = 0;
  const Eigen::Vector3d from = mesh.points.col(mesh.triangles.front()[0]);
  for (const auto& [a, b, c] : mesh.triangles)
    volume += (mesh.points.col(a) - from).dot((mesh.points.col(b) - from).cross(mesh.points.col(c) - from)) / 6;
  return volume;
}

Eigen::Vector3d enclosedCentroid(const SurfaceMesh& mesh) {
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const Eigen::Vector3d from = mesh.points.col(mesh.triangles.front()[0]);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d u = mesh.points.col(a) - from, v = mesh.points.col(b) - from, w = mesh.points.col(c) - from;
    const double part = u.dot(v.cross(w)) / 6;
    volume += part;
    moment += 0.25 * part * (u + v + w);
  }
  return from + moment / volume;
}

}  // namespace pliant::geometry
