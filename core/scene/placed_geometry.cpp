#include "core/scene/placed_geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <set>

#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/tet_mesh.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/seams.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

/// A vector of the scene, filled with zeros to three entries.
Eigen::Vector3d toPoint(const Json& values) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < values.size(); ++i) point[static_cast<int>(i)] = values[i].get<double>();
  return point;
}

Eigen::Matrix3Xd toPoints(const Json& values) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = toPoint(values[i]);
  return points;
}

/// Lists of node indices below `nodeCount`, such as triangles.
template <std::size_t corners>
std::vector<std::array<int, corners>> nodeTuples(const Json& lists, const std::string& pointer, int nodeCount) {
  std::vector<std::array<int, corners>> tuples;
  for (std::size_t t = 0; t < lists.size(); ++t) {
    const auto nodes = lists[t].get<std::array<int, corners>>();
    for (std::size_t i = 0; i < corners; ++i) {
      if (nodes[i] >= nodeCount)
        throw InputError(
            childPointer(childPointer(pointer, t), i),
            "There is no node " + std::to_string(nodes[i]) + "; the geometry has " + std::to_string(nodeCount) + ".");
      // Triangles are checked as a mesh.
      if (corners != 3 && std::find(nodes.begin(), nodes.begin() + i, nodes[i]) != nodes.begin() + i)
        throw InputError(
            childPointer(childPointer(pointer, t), i), "Node " + std::to_string(nodes[i]) + " is named twice.");
    }
    tuples.push_back(nodes);
  }
  return tuples;
}

/// Checks the tetrahedra, turns them the right way round, and makes their boundary the triangles if there are none.
void finishTetrahedra(PlacedGeometry& geometry) {
  geometry::TetMesh mesh{geometry.mesh.points, geometry.tetrahedra, {}};
  geometry::checkTetMesh(mesh);
  geometry.tetrahedra = geometry::orientTetrahedra(mesh);
  if (geometry.mesh.triangles.empty()) geometry.mesh.triangles = geometry::boundaryTriangles(geometry.tetrahedra);
}

void addInlineMesh(const Json& entry, const std::string& pointer, PlacedGeometry& geometry) {
  geometry.mesh.points = toPoints(entry["points"]);
  const int nodes = geometry.nodeCount();
  geometry.mesh.triangles = nodeTuples<3>(entry["triangles"], pointer + "/triangles", nodes);
  geometry.segments = nodeTuples<2>(entry["segments"], pointer + "/segments", nodes);
  geometry.tetrahedra = nodeTuples<4>(entry["tetrahedra"], pointer + "/tetrahedra", nodes);
  if (geometry.mesh.triangles.empty() && geometry.segments.empty() && geometry.tetrahedra.empty())
    throw InputError(pointer, "The mesh has no triangles, segments or tetrahedra.");
  for (std::size_t g = 0; g < entry["groups"].size(); ++g) {
    const Json& group = entry["groups"][g];
    const std::string place = childPointer(pointer + "/groups", g) + "/nodes";
    for (std::size_t i = 0; i < group["nodes"].size(); ++i)
      if (group["nodes"][i].get<int>() >= nodes)
        throw InputError(childPointer(place, i), "There is no node " + group["nodes"][i].dump() +
                                                     "; the geometry has " + std::to_string(nodes) + ".");
    geometry.mesh.groups[group["name"]] = group["nodes"].get<std::vector<int>>();
  }
  if (!geometry.mesh.triangles.empty()) geometry::checkMesh(geometry.mesh);
  if (!geometry.tetrahedra.empty()) finishTetrahedra(geometry);
}

void addBlocks(const Json& entry, PlacedGeometry& geometry) {
  std::vector<geometry::Block> blocks;
  for (const Json& block : entry["blocks"])
    blocks.push_back({block["name"], toPoint(block["minimum"]), toPoint(block["maximum"])});
  geometry::TetMesh mesh = geometry::makeBlocks(blocks, toPoint(entry["cell"]));
  geometry.mesh.points = std::move(mesh.points);
  geometry.mesh.groups = std::move(mesh.groups);
  geometry.mesh.triangles = geometry::boundaryTriangles(mesh.tetrahedra);
  geometry.tetrahedra = std::move(mesh.tetrahedra);
}

geometry::SurfaceMesh fileMesh(const Json& entry, const std::string& pointer, const std::filesystem::path& directory) {
  const auto file = directory / std::filesystem::path(entry["path"].get<std::string>());
  geometry::SurfaceMesh mesh = locate(pointer + "/path", [&] {
    return geometry::weldMesh(geometry::readMesh(file, entry["scale"]), entry["weld_tolerance"]);
  });
  geometry::checkMesh(mesh);
  return mesh;
}

geometry::SurfaceMesh makeSurface(const Json& entry, const std::string& pointer,
                                  const std::filesystem::path& directory) {
  const std::string type = entry["type"];
  if (type == "fork") {
    geometry::ForkShape shape;
    shape.handleLength = entry["handle_length"];
    shape.prongLength = entry["prong_length"];
    shape.width = entry["width"];
    shape.spacing = entry["spacing"];
    shape.handleCells = entry["handle_cells"];
    shape.prongCells = entry["prong_cells"];
    shape.widthCells = entry["width_cells"];
    return geometry::makeFork(shape);
  }
  if (type == "strip")
    return geometry::makeStrip(entry["length"], entry["width"], entry["length_cells"], entry["width_cells"]);
  if (type == "grid")
    return geometry::makeGrid(entry["length"], entry["width"], entry["length_cells"], entry["width_cells"]);
  if (type == "file") return fileMesh(entry, pointer, directory);
  geometry::SurfaceMesh points;
  points.points = toPoints(entry["points"]);
  return points;
}

void place(const Json& entry, int dimension, Eigen::Matrix3Xd& points, const std::string& pointer) {
  if (entry.contains("rotation")) {
    const Eigen::Vector3d axis = toPoint(entry["rotation"]["axis"]).normalized();
    points = Eigen::AngleAxisd(entry["rotation"]["angle"], axis).toRotationMatrix() * points;
  }
  points.colwise() += toPoint(entry["position"]);
  const double size = points.cwiseAbs().maxCoeff();
  if (dimension == 2 && points.row(2).cwiseAbs().maxCoeff() > 1e-9 * size)
    throw InputError(pointer, "The geometry does not lie in the plane z = 0, but the scene's dimension is 2.");
}

[[noreturn]] void nothing(const std::string& pointer, const PlacedGeometry& geometry, const std::string& what) {
  throw InputError(pointer, what + " of the geometry " + quote(geometry.name) + ", which has " +
                                std::to_string(geometry.nodeCount()) + " nodes.");
}

std::vector<int> nodesInBox(const Json& box, const std::string& pointer, const PlacedGeometry& geometry) {
  const Eigen::Vector3d low = toPoint(box["minimum"]), high = toPoint(box["maximum"]);
  std::vector<int> nodes;
  for (int n = 0; n < geometry.nodeCount(); ++n) {
    bool inside = true;
    for (int axis = 0; axis < static_cast<int>(box["minimum"].size()); ++axis)
      inside = inside && geometry.mesh.points(axis, n) >= low[axis] && geometry.mesh.points(axis, n) <= high[axis];
    if (inside) nodes.push_back(n);
  }
  if (nodes.empty()) nothing(pointer + "/box", geometry, "The box holds no node");
  return nodes;
}

}  // namespace

std::vector<PlacedGeometry> placeGeometry(const Scene& scene) {
  const Json& entries = scene.normalized()["geometry"];
  const int dimension = scene.normalized()["dimension"];
  std::vector<PlacedGeometry> geometries;
  int nodeCount = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string pointer = childPointer("/geometry", i);
    PlacedGeometry geometry;
    geometry.name = entries[i]["name"];
    geometry.firstNode = nodeCount;
    locate(pointer, [&] {
      if (entries[i]["type"] == "mesh")
        addInlineMesh(entries[i], pointer, geometry);
      else if (entries[i]["type"] == "blocks")
        addBlocks(entries[i], geometry);
      else
        geometry.mesh = makeSurface(entries[i], pointer, scene.directory());
    });
    place(entries[i], dimension, geometry.mesh.points, pointer);
    geometry.unsewn = geometry.mesh.points;
    geometry.ownCount = geometry.nodeCount();
    geometry.nodes.resize(static_cast<std::size_t>(geometry.ownCount));
    std::iota(geometry.nodes.begin(), geometry.nodes.end(), nodeCount);
    nodeCount += geometry.ownCount;
    geometries.push_back(std::move(geometry));
  }
  if (nodeCount == 0) throw InputError("/geometry", "The scene has no nodes.");
  sewSeams(scene.normalized()["seams"], geometries);
  return geometries;
}

std::vector<int> selectNodes(const Json& selection, const std::string& pointer,
                             const std::vector<PlacedGeometry>& geometries) {
  const auto found = std::find_if(
      geometries.begin(), geometries.end(), [&](const PlacedGeometry& g) { return g.name == selection["geometry"]; });
  const PlacedGeometry& geometry = *found;
  std::set<int> nodes;
  if (selection.contains("nodes")) {
    const Json& wanted = selection["nodes"];
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i].get<int>() >= geometry.nodeCount())
        nothing(childPointer(pointer + "/nodes", i), geometry, "There is no node " + wanted[i].dump());
      nodes.insert(wanted[i].get<int>());
    }
  } else if (selection.contains("group")) {
    const std::string name = selection["group"];
    const auto group = geometry.mesh.groups.find(name);
    if (group == geometry.mesh.groups.end()) {
      std::string known;
      for (const auto& entry : geometry.mesh.groups) known += (known.empty() ? "" : ", ") + quote(entry.first);
      throw InputError(pointer + "/group", "The geometry " + quote(geometry.name) + " has no group " + quote(name) +
                                               "; its groups: " + (known.empty() ? "none" : known) + ".");
    }
    nodes.insert(group->second.begin(), group->second.end());
  } else if (selection.contains("nearest")) {
    const Eigen::Vector3d target = toPoint(selection["nearest"]);
    Eigen::Index nearest = 0;
    (geometry.mesh.points.colwise() - target).colwise().squaredNorm().minCoeff(&nearest);
    nodes.insert(static_cast<int>(nearest));
  } else {
    for (const int node : nodesInBox(selection["box"], pointer, geometry)) nodes.insert(node);
  }
  std::set<int> result;
  for (const int node : nodes) result.insert(geometry.nodes[static_cast<std::size_t>(node)]);
  return {result.begin(), result.end()};
}

int selectNode(const Json& selection, const std::string& pointer, const std::vector<PlacedGeometry>& geometries) {
  const std::vector<int> nodes = selectNodes(selection, pointer, geometries);
  if (nodes.size() != 1)
    throw InputError(pointer, "Expected a single node, but the selection has " + std::to_string(nodes.size()) + ".");
  return nodes.front();
}

}  // namespace pliant::scene
