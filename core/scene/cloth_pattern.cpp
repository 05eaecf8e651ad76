#include <Eigen/Geometry>

#include "core/scene/cloth_builder.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

using Corners = std::vector<std::array<Eigen::Vector3d, 3>>;  ///< of each triangle at rest [m]

RestShape patternOfPoints(const Json& points, const std::string& pointer, const PlacedGeometry& geometry) {
  if (static_cast<int>(points.size()) != geometry.nodeCount())
    throw InputError(pointer, "The pattern has " + std::to_string(points.size()) + " points, but the geometry " +
                                  quote(geometry.name) + " has " + std::to_string(geometry.nodeCount()) + " nodes.");
  RestShape rest{mechanics::Vector(3 * geometry.nodeCount()), geometry.mesh.triangles};
  for (int node = 0; node < geometry.nodeCount(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      rest.positions[3 * node + axis] =
          points[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)].get<double>();
  return rest;
}

Corners cornersOfFile(const geometry::SurfaceMesh& file, const std::string& pointer, const PlacedGeometry& geometry) {
  if (file.triangles.size() != geometry.mesh.triangles.size())
    throw InputError(pointer, "The pattern has " + std::to_string(file.triangles.size()) +
                                  " triangles, but the geometry " + quote(geometry.name) + " has " +
                                  std::to_string(geometry.mesh.triangles.size()) + ".");
  Corners corners;
  for (const auto& [a, b, c] : file.triangles)
    corners.push_back({file.points.col(a), file.points.col(b), file.points.col(c)});
  return corners;
}

Corners cornersOfTexture(double scale, const std::string& pointer, const PlacedGeometry& geometry) {
  if (geometry.mesh.texture.empty())
    throw InputError(pointer, "The triangles of the geometry " + quote(geometry.name) +
                                  " have no texture coordinates; only those of a \"file\" may have them.");
  Corners corners;
  for (const auto& triangle : geometry.mesh.texture) {
    std::array<Eigen::Vector3d, 3>& places = corners.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) places[i] << scale * triangle[i], 0;
  }
  return corners;
}

/// Corners of one node are one where they rest in the same place. Pieces of a flat pattern may lie upon each other, as
/// the front and the back of a garment do: where one of them is turned over, the edge between them is a seam as well.
class CornerJoiner {
 public:
  explicit CornerJoiner(const Corners& corners, int nodeCount) : ofNode_(static_cast<std::size_t>(nodeCount)) {
    Eigen::AlignedBox3d box;
    for (const auto& places : corners)
      for (const Eigen::Vector3d& place : places) box.extend(place);
    tolerance_ = 1e-6 * box.diagonal().norm();
    flat_ = box.sizes().z() <= tolerance_;
  }

  void add(const std::array<int, 3>& nodes, const std::array<Eigen::Vector3d, 3>& places) {
    const bool turned = flat_ && (places[1] - places[0]).cross(places[2] - places[0]).z() < 0;
    auto& triangle = triangles_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = join(nodes[i], places[i], turned);
  }

  RestShape finish() {
    RestShape rest{mechanics::Vector(3 * static_cast<Eigen::Index>(places_.size())), std::move(triangles_)};
    for (std::size_t i = 0; i < places_.size(); ++i)
      rest.positions.segment<3>(3 * static_cast<Eigen::Index>(i)) = places_[i];
    return rest;
  }

 private:
  int join(int node, const Eigen::Vector3d& place, bool turned) {
    auto& known = ofNode_[static_cast<std::size_t>(node)];
    for (const auto& [corner, side] : known)
      if (side == turned && (places_[static_cast<std::size_t>(corner)] - place).norm() <= tolerance_) return corner;
    known.push_back({static_cast<int>(places_.size()), turned});
    places_.push_back(place);
    return known.back().first;
  }

  double tolerance_;
  bool flat_;
  std::vector<std::vector<std::pair<int, bool>>> ofNode_;  ///< corners, and whether their triangles are turned over
  std::vector<Eigen::Vector3d> places_;
  mechanics::Triangles triangles_;
};

bool shareCorner(const RestShape& rest, const mechanics::Triangles& nodes, const geometry::MeshEdge& edge, int node) {
  std::array<int, 2> corner{};
  for (std::size_t side = 0; side < 2; ++side) {
    const auto t = static_cast<std::size_t>(edge.triangles[side]);
    for (std::size_t i = 0; i < 3; ++i)
      if (nodes[t][i] == node) corner[side] = rest.triangles[t][i];
  }
  return corner[0] == corner[1];
}

RestShape patternOfCorners(const Corners& corners, const std::string& pointer, const PlacedGeometry& geometry) {
  const mechanics::Triangles& triangles = geometry.mesh.triangles;
  CornerJoiner joiner(corners, geometry.nodeCount());
  for (std::size_t t = 0; t < triangles.size(); ++t) joiner.add(triangles[t], corners[t]);
  RestShape rest = joiner.finish();
  int inner = 0, seams = 0;
  for (const geometry::MeshEdge& edge : geometry::meshEdges(triangles)) {
    if (edge.triangles[1] < 0) continue;
    ++inner;
    if (!shareCorner(rest, triangles, edge, edge.nodes[0]) || !shareCorner(rest, triangles, edge, edge.nodes[1]))
      ++seams;
  }
  if (2 * seams > inner)
    throw InputError(pointer, "The pattern's triangles are not those of the geometry " + quote(geometry.name) +
                                  " in the same order: of the " + std::to_string(inner) + " edges between them, " +
                                  std::to_string(seams) + " would be seams.");
  return rest;
}

}  // namespace

RestShape restShapeOf(const Json& element, const std::string& pointer, const PlacedGeometry& geometry,
                      const std::filesystem::path& directory) {
  if (!element.contains("pattern")) return {geometry.unsewn.reshaped(), geometry.mesh.triangles};
  const Json& pattern = element["pattern"];
  const std::string place = pointer + "/pattern";
  if (pattern.contains("points")) return patternOfPoints(pattern["points"], place + "/points", geometry);
  if (pattern.contains("from"))
    return patternOfCorners(cornersOfTexture(pattern["scale"], place + "/from", geometry), place + "/from", geometry);
  return locate(place + "/path", [&] {
    const auto file = directory / std::filesystem::path(pattern["path"].get<std::string>());
    const geometry::SurfaceMesh mesh = geometry::readMesh(file, pattern["scale"]);
    return patternOfCorners(cornersOfFile(mesh, place + "/path", geometry), place + "/path", geometry);
  });
}

}  // namespace pliant::scene
