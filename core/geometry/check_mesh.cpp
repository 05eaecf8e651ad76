#include <Eigen/Geometry>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/geometry/mesh_checks.hpp"
#include "core/geometry/orientation.hpp"
#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

namespace {

std::string named(const char* kind, std::size_t index) { return std::string(kind) + " " + std::to_string(index); }

void checkPoints(const SurfaceMesh& mesh) {
  for (Eigen::Index n = 0; n < mesh.points.cols(); ++n)
    if (!mesh.points.col(n).allFinite())
      throw base::InputError("", named("point", static_cast<std::size_t>(n)) + " has a coordinate that is not finite");
}

void checkIndices(const SurfaceMesh& mesh) {
  const auto inRange = [&](int node) { return node >= 0 && node < mesh.points.cols(); };
  const std::string count = std::to_string(mesh.points.cols());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int node : mesh.triangles[t])
      if (!inRange(node))
        throw base::InputError(
            "", named("triangle", t) + " names point " + std::to_string(node) + ", but there are " + count + " points");
  for (const auto& [name, nodes] : mesh.groups)
    for (const int node : nodes)
      if (!inRange(node))
        throw base::InputError(
            "", "group '" + name + "' names point " + std::to_string(node) + ", but there are " + count + " points");
}

bool isDegenerate(const SurfaceMesh& mesh, const std::array<int, 3>& triangle) {
  const Eigen::Vector3d a = mesh.points.col(triangle[0]), b = mesh.points.col(triangle[1]),
                        c = mesh.points.col(triangle[2]);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double area = 0.5 * (b - a).cross(c - a).norm();
  return !(area > smallestRelativeArea * longest);
}

void checkShapes(const SurfaceMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (isDegenerate(mesh, mesh.triangles[t]))
      throw base::InputError(
          "", named("triangle", t) + " has no area: its corners are points " + std::to_string(mesh.triangles[t][0]) +
                  ", " + std::to_string(mesh.triangles[t][1]) + " and " + std::to_string(mesh.triangles[t][2]));
}

void checkDuplicates(const SurfaceMesh& mesh) {
  std::vector<std::pair<std::array<int, 3>, std::size_t>> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<int, 3> sorted = mesh.triangles[t];
    std::sort(sorted.begin(), sorted.end());
    corners.push_back({sorted, t});
  }
  std::sort(corners.begin(), corners.end());
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (corners[i].first == corners[i - 1].first)
      throw base::InputError("", named("triangle", corners[i].second) + " has the same corners as " +
                                     named("triangle", corners[i - 1].second));
}

}  // namespace

void checkPointsAndIndices(const SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) throw base::InputError("", "the mesh has no triangles");
  checkPoints(mesh);
  checkIndices(mesh);
}

void checkMesh(const SurfaceMesh& mesh) {
  checkPointsAndIndices(mesh);
  checkShapes(mesh);
  checkDuplicates(mesh);
  orientTriangles(mesh.triangles);
}

}  // namespace pliant::geometry
