#include "core/geometry/thick_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/geometry/orientation.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;

/// Points go at most this many times as far as on a flat surface.
constexpr double farthestMitre = 2;

std::string placeText(const Vector3d& place) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis ? ", " : "(") + base::formatQuantity(place[axis], base::dimensions::length);
  return text + ")";
}

Vector3d unitNormal(const SurfaceMesh& mesh, const std::array<int, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  return (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).normalized();
}

/// At corner i of a triangle [rad].
double angleAt(const SurfaceMesh& mesh, const std::array<int, 3>& triangle, int i) {
  const Vector3d at = mesh.points.col(triangle[i]), first = mesh.points.col(triangle[(i + 1) % 3]) - at,
                 second = mesh.points.col(triangle[(i + 2) % 3]) - at;
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

/// From the middle to the side that normals point to, at each point.
Eigen::Matrix3Xd sideOf(const SurfaceMesh& mesh, const std::vector<double>& thickness) {
  const Eigen::Index count = mesh.points.cols();
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, count);
  Eigen::VectorXd angles = Eigen::VectorXd::Zero(count), halves = angles, agreement = angles;
  const auto forCorners = [&](const auto& visit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vector3d normal = unitNormal(mesh, mesh.triangles[t]);
      for (int i = 0; i < 3; ++i) visit(t, mesh.triangles[t][i], angleAt(mesh, mesh.triangles[t], i), normal);
    }
  };
  forCorners([&](std::size_t t, int point, double angle, const Vector3d& normal) {
    normals.col(point) += angle * normal;
    angles[point] += angle;
    halves[point] += 0.5 * angle * thickness[t];
  });
  normals.colwise().normalize();
  forCorners([&](std::size_t, int point, double angle, const Vector3d& normal) {
    agreement[point] += angle * normal.dot(normals.col(point));
  });
  for (Eigen::Index i = 0; i < count; ++i)
    normals.col(i) *= halves[i] / angles[i] / std::max(agreement[i] / angles[i], 1 / farthestMitre);
  return normals;
}

}  // namespace

SurfaceMesh withoutLoosePoints(const SurfaceMesh& mesh) {
  std::vector<int> index(static_cast<std::size_t>(mesh.points.cols()), -1);
  for (const auto& triangle : mesh.triangles)
    for (const int point : triangle) index[point] = 0;
  SurfaceMesh result;
  int count = 0;
  for (int& place : index)
    if (place == 0) place = count++;
  result.points.resize(3, count);
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] >= 0) result.points.col(index[i]) = mesh.points.col(static_cast<Eigen::Index>(i));
  for (const auto& [a, b, c] : mesh.triangles) result.triangles.push_back({index[a], index[b], index[c]});
  return result;
}

SurfaceMesh thickenSurface(const SurfaceMesh& middle, const std::vector<double>& thickness) {
  checkMesh(middle);
  for (const double value : thickness)
    if (!(value > 0)) throw base::InputError("", "a thickness must be above 0");
  SurfaceMesh mesh = withoutLoosePoints(middle);
  mesh.triangles = orientTriangles(mesh.triangles);
  const Eigen::Index count = mesh.points.cols();
  const int below = static_cast<int>(count);

  std::vector<std::array<int, 2>> boundary;  // as their triangles run along them
  for (const MeshEdge& edge : meshEdges(mesh.triangles)) {
    if (edge.triangles[1] >= 0) continue;
    const auto& triangle = mesh.triangles[edge.triangles[0]];
    for (int i = 0; i < 3; ++i) {
      const int from = triangle[i], to = triangle[(i + 1) % 3];
      if (std::minmax(from, to) == std::minmax(edge.nodes[0], edge.nodes[1])) boundary.push_back({from, to});
    }
  }
  std::vector<int> begun(static_cast<std::size_t>(count), 0);
  for (const auto& [from, to] : boundary)
    if (++begun[from] > 1)
      throw base::InputError("", "the surface touches itself at one point, near " + placeText(mesh.points.col(from)) +
                                     ", where it would have no thickness");

  const Eigen::Matrix3Xd side = sideOf(mesh, thickness);
  if (!side.allFinite()) throw base::InputError("", "the surface is folded onto itself and has no normal there");
  SurfaceMesh solid;
  solid.points.resize(3, 2 * count);
  solid.points << mesh.points + side, mesh.points - side;
  solid.triangles = mesh.triangles;
  for (const auto& [a, b, c] : mesh.triangles) solid.triangles.push_back({a + below, c + below, b + below});
  for (const auto& [from, to] : boundary) {
    solid.triangles.push_back({to, from, from + below});
    solid.triangles.push_back({to, from + below, to + below});
  }
  return solid;
}

}  // namespace pliant::geometry
