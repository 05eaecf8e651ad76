#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace pliant::geometry {

/// A mesh of tetrahedra. `points` is 3 x n [m]; a tetrahedron (a, b, c, d) is positively oriented: (b - a), (c - a) and
/// (d - a) form a right-handed basis. `groups` are named sets of nodes.
struct TetMesh {
  Eigen::Matrix3Xd points;
  std::vector<std::array<int, 4>> tetrahedra;
  std::map<std::string, std::vector<int>> groups;
};

/// A tetrahedron whose volume is at most this fraction of its longest edge cubed is degenerate.
inline constexpr double smallestRelativeVolume = 1e-10;

/// Throws base::InputError (location empty) with a sentence that names the tetrahedron or point: no tetrahedra, NaN or
/// infinity, an index out of range, a degenerate tetrahedron (zero volume, relative to its longest edge), two
/// tetrahedra with the same corners, a triangle that is a face of more than two. Orientation is not checked.
void checkTetMesh(const TetMesh& mesh);

/// The tetrahedra with two corners exchanged where they are negatively oriented.
std::vector<std::array<int, 4>> orientTetrahedra(const TetMesh& mesh);

/// The faces that belong to one tetrahedron alone, seen counter-clockwise from outside, in the order of the tetrahedra
/// (which must be positively oriented).
std::vector<std::array<int, 3>> boundaryTriangles(const std::vector<std::array<int, 4>>& tetrahedra);

/// The sum of the volumes [m³]; negatively oriented tetrahedra count negatively.
double volumeOf(const TetMesh& mesh);

/// A box whose sides lie on the planes of the cells.
struct Block {
  std::string name;  ///< of the group of its nodes; empty: no group
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
};

/// The union of boxes made of cells of the size `cell` [m], whose corners lie at multiples of it from the first box's
/// minimum. Each cell is five tetrahedra, alternating so that neighbours share whole faces and a mesh with an even
/// number of cells is symmetric. Boxes may overlap; nodes where they meet are one. Groups: a block's name, and its
/// sides "NAME.x_min", "NAME.x_max", ... to "NAME.z_max". Throws base::InputError if a box is no whole number of cells
/// long, off the cells, or has a name twice, or if there are more than 2 million cells.
TetMesh makeBlocks(const std::vector<Block>& blocks, const Eigen::Vector3d& cell);

}  // namespace pliant::geometry
