#include "core/scene/cloth_builder.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

Eigen::Matrix3Xd patternPoints(const Json& points, const std::string& pointer, const PlacedGeometry& geometry) {
  if (static_cast<int>(points.size()) != geometry.nodeCount())
    throw InputError(pointer, "The pattern has " + std::to_string(points.size()) + " points, but the geometry " +
                                  quote(geometry.name) + " has " + std::to_string(geometry.nodeCount()) + " nodes.");
  Eigen::Matrix3Xd result(3, geometry.nodeCount());
  for (int node = 0; node < geometry.nodeCount(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      result(axis, node) = points[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)].get<double>();
  return result;
}

/// A file's corners are not welded, and its points may be numbered otherwise: triangle by triangle they are the nodes'.
Eigen::Matrix3Xd patternOfFile(const geometry::SurfaceMesh& file, const std::string& pointer,
                               const PlacedGeometry& geometry) {
  const auto& triangles = geometry.mesh.triangles;
  if (file.triangles.size() != triangles.size())
    throw InputError(pointer, "The pattern has " + std::to_string(file.triangles.size()) +
                                  " triangles, but the geometry " + quote(geometry.name) + " has " +
                                  std::to_string(triangles.size()) + ".");
  Eigen::Matrix3Xd result = geometry.mesh.points;
  std::vector<char> known(static_cast<std::size_t>(geometry.nodeCount()), 0);
  const double size = (file.points.rowwise().maxCoeff() - file.points.rowwise().minCoeff()).norm();
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const int node = triangles[t][corner];
      const Eigen::Vector3d place = file.points.col(file.triangles[t][corner]);
      if (known[static_cast<std::size_t>(node)] && (result.col(node) - place).norm() > 1e-6 * size)
        throw InputError(pointer, "The pattern's triangles are not those of the geometry " + quote(geometry.name) +
                                      " in the same order: node " + std::to_string(node) + " would be in two places.");
      result.col(node) = place;
      known[static_cast<std::size_t>(node)] = 1;
    }
  return result;
}

}  // namespace

mechanics::Vector restShapeOf(const Json& element, const std::string& pointer, const PlacedGeometry& geometry,
                              const std::filesystem::path& directory, const mechanics::Vector& positions) {
  if (!element.contains("pattern")) return positions;
  const Json& pattern = element["pattern"];
  const std::string place = pointer + "/pattern";
  const Eigen::Matrix3Xd points =
      pattern.contains("points")
          ? patternPoints(pattern["points"], place + "/points", geometry)
          : locate(place + "/path", [&] {
              const auto file = directory / std::filesystem::path(pattern["path"].get<std::string>());
              return patternOfFile(geometry::readMesh(file, pattern["scale"]), place + "/path", geometry);
            });
  mechanics::Vector result = positions;
  result.segment(3 * geometry.firstNode, points.size()) = points.reshaped();
  return result;
}

}  // namespace pliant::scene
