#include "core/scene/body_builder.hpp"

#include <Eigen/Geometry>

#include "core/geometry/surface_mesh.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using Eigen::Vector3d;

namespace {

Vector3d componentsOf(const Json& values) {
  return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
}

/// Axis times angle.
Vector3d turnOf(const Json& entry) {
  return entry["angle"].get<double>() * componentsOf(entry["axis"]).stableNormalized();
}

void buildCapsule(const Json& entry, const std::string& pointer, mechanics::Body& body) {
  body.points.resize(3, 2);
  body.points << componentsOf(entry["from"]), componentsOf(entry["to"]);
  if (body.points.col(0) == body.points.col(1))
    throw InputError(pointer + "/to", "A capsule needs two different ends; use a sphere.");
  body.edges = {{0, 1}};
  body.centre = body.points.rowwise().mean();
  body.radius = entry["radius"];
}

void buildGround(const Json& entry, const std::string& pointer, mechanics::Body& body) {
  const Vector3d normal = componentsOf(entry["normal"]);
  if (normal.isZero(0)) throw InputError(pointer + "/normal", "A normal needs a direction.");
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  const double half = 0.5 * entry["size"].get<double>();
  body.points.resize(3, 4);
  body.points << -half, half, half, -half, -half, -half, half, half, 0, 0, 0, 0;
  body.centre = componentsOf(entry["point"]);
  body.points = (turn.toRotationMatrix() * body.points).colwise() + body.centre;
  body.triangles = {{0, 1, 2}, {0, 2, 3}};
}

void buildMesh(const Scene& scene, const Json& entry, const std::string& pointer, mechanics::Body& body) {
  const auto file = scene.directory() / std::filesystem::path(entry["file"].get<std::string>());
  // Surfaces made of corners that only look joined have gaps that edges find.
  geometry::SurfaceMesh mesh = locate(pointer + "/file", [&] {
    const geometry::SurfaceMesh read = geometry::readMesh(file, entry["scale"]);
    const double size = (read.points.rowwise().maxCoeff() - read.points.rowwise().minCoeff()).norm();
    return geometry::weldMesh(read, 1e-6 * size);
  });
  body.points = std::move(mesh.points);
  if (entry.contains("rotation")) {
    const mechanics::Keyframe turn{0, Vector3d::Zero(), turnOf(entry["rotation"])};
    body.points = mechanics::placementAt({turn}, 0).apply(body.points, Vector3d::Zero());
  }
  body.points.colwise() += componentsOf(entry["position"]);
  body.triangles = std::move(mesh.triangles);
  body.centre = body.points.rowwise().mean();
  body.radius = entry["thickness"];
}

}  // namespace

std::vector<mechanics::Keyframe> motionOf(const Json& entry) {
  std::vector<mechanics::Keyframe> path;
  for (const Json& keyframe : entry["path"])
    path.push_back({keyframe["time"], componentsOf(keyframe["translation"]), turnOf(keyframe)});
  return path;
}

std::vector<mechanics::Body> buildBodies(const Scene& scene) {
  const Json& entries = scene.normalized()["bodies"];
  std::vector<mechanics::Body> bodies;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Json& entry = entries[i];
    const std::string pointer = childPointer("/bodies", i);
    mechanics::Body& body = bodies.emplace_back();
    body.name = entry["name"];
    body.path = motionOf(entry);
    const std::string type = entry["type"];
    locate(pointer, [&] {
      if (type == "sphere") {
        body.points = body.centre = componentsOf(entry["center"]);
        body.radius = entry["radius"];
      } else if (type == "capsule") {
        buildCapsule(entry, pointer, body);
      } else if (type == "ground") {
        buildGround(entry, pointer, body);
      } else {
        buildMesh(scene, entry, pointer, body);
      }
    });
  }
  return bodies;
}

}  // namespace pliant::scene
