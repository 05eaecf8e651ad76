#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

namespace pliant::interlock {

/// Directions, and closed triangles between them, seen counterclockwise from outside.
struct SphereMesh {
  std::vector<Eigen::Vector3d> directions;  ///< unit vectors
  std::vector<std::array<int, 3>> triangles;
  /// For each direction the two in whose middle it was put; -1 for those of the icosahedron.
  std::vector<std::array<int, 2>> parents;
};

/// The icosahedron with each triangle cut into four `subdivisions` times: 12, 42, 162, 642, 2562 directions.
SphereMesh icosphere(int subdivisions);

/// The mesh with the marked edges (a < b) cut in the middle; triangles with one, two or three such edges become two,
/// three or four, so that it stays closed. New directions come last, sorted by edge.
SphereMesh refined(const SphereMesh& mesh, const std::vector<std::array<int, 2>>& edges);

/// All edges (a < b), sorted. Two triangles share each.
std::vector<std::array<int, 2>> edgesOf(const SphereMesh& mesh);

}  // namespace pliant::interlock
