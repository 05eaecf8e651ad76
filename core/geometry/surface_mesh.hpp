#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pliant::geometry {

/// A triangle mesh. `points` is 3 x n [m]; a plane mesh has z = 0. `groups` are named sets of nodes (generated meshes
/// name their ends, such as "base").
struct SurfaceMesh {
  Eigen::Matrix3Xd points;
  std::vector<std::array<int, 3>> triangles;
  std::map<std::string, std::vector<int>> groups;
};

/// A triangle whose area is at most this fraction of its longest edge squared is degenerate.
inline constexpr double smallestRelativeArea = 1e-10;

/// Throws base::InputError (location empty) with a sentence that names the triangle or point: no triangles, NaN or
/// infinity, an index out of range, a degenerate triangle (zero area, relative to its longest edge), an edge with more
/// than two triangles, neighbours of opposite orientation that cannot be made consistent.
void checkMesh(const SurfaceMesh& mesh);

/// Points closer than `tolerance` [m] made one, triangles oriented consistently within each connected part; triangles
/// that collapse by welding are an error as in checkMesh.
SurfaceMesh weldMesh(const SurfaceMesh& mesh, double tolerance);

/// Reads STL, OBJ or PLY through assimp, lengths multiplied by `scale`. Throws base::InputError if the file is missing,
/// not readable, or holds no triangles. Does not weld.
SurfaceMesh readMesh(const std::filesystem::path& file, double scale);

/// Writes STL, OBJ, PLY, glTF, glb or 3MF, chosen by the extension. Throws base::InputError.
void writeMesh(const SurfaceMesh& mesh, const std::filesystem::path& file);

/// Edges as node pairs (a < b, sorted), with the triangles on their sides (-1: none). Throws base::InputError if an edge
/// has more than two.
struct MeshEdge {
  std::array<int, 2> nodes;
  std::array<int, 2> triangles;
};
std::vector<MeshEdge> meshEdges(const std::vector<std::array<int, 3>>& triangles);

}  // namespace pliant::geometry
