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
  /// Texture coordinates of each triangle's corners, if a file gives them: of a garment, its flat pattern. Empty if
  /// not.
  std::vector<std::array<Eigen::Vector2d, 3>> texture;
};

/// A triangle whose area is at most this fraction of its longest edge squared is degenerate.
inline constexpr double smallestRelativeArea = 1e-10;

/// Throws base::InputError (location empty) with a sentence that names the triangle or point: no triangles, NaN or
/// infinity, an index out of range, a degenerate triangle (zero area, relative to its longest edge), two triangles with
/// the same corners, an edge with more than two triangles, neighbours of opposite orientation that cannot be made
/// consistent.
void checkMesh(const SurfaceMesh& mesh);

/// Points closer than `tolerance` [m] made one, triangles oriented consistently within each connected part (as its
/// first triangle is). Each point joins the first one kept that is near enough. The result is checked as in checkMesh,
/// so that triangles that collapse by welding are an error; triangles keep their order, and points that remain keep
/// theirs.
SurfaceMesh weldMesh(const SurfaceMesh& mesh, double tolerance);

/// Reads an STL, OBJ, PLY, glTF or glb file through assimp, lengths multiplied by `scale`. Polygons become triangles,
/// points of no triangle are left out; nothing is welded, and there are no groups. Texture coordinates are those of the
/// file, not scaled, if all triangles have them. Coordinates have passed through floats (7 digits). Throws
/// base::InputError (location empty) if the file is missing, not readable, or holds no triangles, or if an index is out
/// of range or a coordinate not finite.
SurfaceMesh readMesh(const std::filesystem::path& file, double scale);

/// Writes STL, OBJ, PLY, glTF (with a .bin beside it), glb or 3MF, chosen by the extension, with coordinates as floats
/// in metres; 3MF in millimetres, as it must be, with six digits. Throws base::InputError (location empty).
void writeMesh(const SurfaceMesh& mesh, const std::filesystem::path& file);

/// Edges as node pairs (a < b, sorted), with the triangles on their sides (-1: none). Throws base::InputError if an
/// edge has more than two.
struct MeshEdge {
  std::array<int, 2> nodes;
  std::array<int, 2> triangles;
};
std::vector<MeshEdge> meshEdges(const std::vector<std::array<int, 3>>& triangles);

}  // namespace pliant::geometry
