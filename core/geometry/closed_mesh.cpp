#include "core/geometry/closed_mesh.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "core/base/error.hpp"
#include "core/geometry/triangle_intersection.hpp"

namespace pliant::geometry {

namespace {

int countSurfaces(const SurfaceMesh& mesh) {
  std::vector<int> root(static_cast<std::size_t>(mesh.points.cols()));
  std::iota(root.begin(), root.end(), 0);
  const auto rootOf = [&](int node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    root[rootOf(b)] = rootOf(a);
    root[rootOf(c)] = rootOf(a);
  }
  int count = 0;
  std::vector<bool> seen(root.size(), false);
  for (const auto& triangle : mesh.triangles) {
    const int at = rootOf(triangle[0]);
    if (!seen[at]) ++count;
    seen[at] = true;
  }
  return count;
}

}  // namespace

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

void checkSolid(const SurfaceMesh& mesh) {
  checkClosed(mesh);
  if (!(enclosedVolume(mesh) > 0))
    throw base::InputError("", "the triangles of the mesh face inwards, but must face outwards");
  const auto meets = findIntersections(mesh.points, mesh.triangles);
  if (!meets.empty()) {
    const auto& [edge, triangle] = meets.front();
    throw base::InputError("", "the mesh runs into itself: the edge between points " + std::to_string(edge[0]) +
                                   " and " + std::to_string(edge[1]) + " meets the triangle of points " +
                                   std::to_string(triangle[0]) + ", " + std::to_string(triangle[1]) + " and " +
                                   std::to_string(triangle[2]));
  }
}

void checkOneSolid(const SurfaceMesh& mesh) {
  checkClosed(mesh);
  if (const int count = countSurfaces(mesh); count > 1)
    throw base::InputError("", "the mesh falls into " + std::to_string(count) + " separate surfaces, but must be one");
  checkSolid(mesh);
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

double surfaceArea(const SurfaceMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).norm();
  return area;
}

int windingNumber(const SurfaceMesh& mesh, const Eigen::Vector3d& place) {
  // Solid angles of the triangles (van Oosterom & Strackee 1983).
  double angle = 0;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.points.col(triangle[0]) - place, b = mesh.points.col(triangle[1]) - place,
                          c = mesh.points.col(triangle[2]) - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

}  // namespace pliant::geometry
