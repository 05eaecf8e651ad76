#include <cmath>
#include <set>
#include <sstream>

#include "core/base/error.hpp"
#include "core/geometry/tet_mesh.hpp"

namespace pliant::geometry {

namespace {

using Lattice = std::array<int, 3>;

constexpr double mostBlockCells = 2e6;
constexpr const char* axisNames = "xyz";

struct LatticeBox {
  Lattice low, high;
};

/// The lattice plane at a coordinate, or an error if there is none.
int latticePlane(double coordinate, double origin, double cell, const std::string& what) {
  const double index = (coordinate - origin) / cell;
  const double nearest = std::round(index);
  if (std::isfinite(index) && std::abs(index) < 1e6 && std::abs(index - nearest) < 1e-6)
    return static_cast<int>(nearest);
  std::ostringstream sentence;
  sentence << what << " lies at " << coordinate << " m, which is no whole number of cells of " << cell
           << " m from the first block's corner";
  throw base::InputError("", sentence.str());
}

LatticeBox latticeBox(const Block& block, const Eigen::Vector3d& origin, const Eigen::Vector3d& cell,
                      const std::string& what) {
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string side = what + "'s side along " + axisNames[axis];
    box.low[axis] = latticePlane(block.minimum[axis], origin[axis], cell[axis], side);
    box.high[axis] = latticePlane(block.maximum[axis], origin[axis], cell[axis], side);
    if (box.high[axis] <= box.low[axis])
      throw base::InputError("", what + " must be at least one cell long along " + axisNames[axis]);
  }
  return box;
}

template <class Visit>
void forEachPoint(const Lattice& low, const Lattice& high, const Visit& visit) {
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) visit(Lattice{i, j, k});
}

/// Five positively oriented tetrahedra; corner c of the cell is at (c & 1, c >> 1 & 1, c >> 2). Cells of the other
/// parity are mirrored, so that the diagonals of common faces agree.
constexpr std::array<std::array<int, 4>, 5> evenCell = {
    {{0, 3, 6, 5}, {1, 0, 5, 3}, {2, 3, 6, 0}, {4, 5, 0, 6}, {7, 6, 3, 5}}};

}  // namespace

TetMesh makeBlocks(const std::vector<Block>& blocks, const Eigen::Vector3d& cell) {
  if (blocks.empty()) throw base::InputError("", "there must be at least one block");
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::isfinite(cell[axis]) && cell[axis] > 0))
      throw base::InputError(
          "", std::string("a cell's size along ") + axisNames[axis] + " must be a finite length above 0");
  std::vector<LatticeBox> boxes;
  std::set<std::string> names;
  double cellCount = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::string what = blocks[b].name.empty() ? "block " + std::to_string(b) : "block '" + blocks[b].name + "'";
    if (!blocks[b].name.empty() && !names.insert(blocks[b].name).second)
      throw base::InputError("", "two blocks have the name '" + blocks[b].name + "'");
    boxes.push_back(latticeBox(blocks[b], blocks.front().minimum, cell, what));
    double cells = 1;
    for (int axis = 0; axis < 3; ++axis) cells *= boxes.back().high[axis] - boxes.back().low[axis];
    cellCount += cells;
  }
  if (cellCount > mostBlockCells)
    throw base::InputError("", "a generated mesh may have at most 2 million cells, but " +
                                   std::to_string(static_cast<long long>(cellCount)) + " are asked for");

  TetMesh mesh;
  std::map<Lattice, int> nodes;
  std::vector<Eigen::Vector3d> points;
  for (const LatticeBox& box : boxes)
    forEachPoint(box.low, box.high, [&](const Lattice& at) {
      if (!nodes.try_emplace(at, static_cast<int>(points.size())).second) return;
      points.push_back(blocks.front().minimum + cell.cwiseProduct(Eigen::Vector3d(at[0], at[1], at[2])));
    });
  mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t n = 0; n < points.size(); ++n) mesh.points.col(static_cast<Eigen::Index>(n)) = points[n];

  std::set<Lattice> done;
  for (const LatticeBox& box : boxes)
    forEachPoint(box.low, {box.high[0] - 1, box.high[1] - 1, box.high[2] - 1}, [&](const Lattice& at) {
      if (!done.insert(at).second) return;
      const bool mirrored = (at[0] + at[1] + at[2]) % 2 != 0;
      for (const auto& corners : evenCell) {
        std::array<int, 4> tetrahedron;
        for (int i = 0; i < 4; ++i) {
          const int c = mirrored ? corners[i] ^ 1 : corners[i];
          tetrahedron[i] = nodes.at({at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2)});
        }
        if (mirrored) std::swap(tetrahedron[2], tetrahedron[3]);
        mesh.tetrahedra.push_back(tetrahedron);
      }
    });

  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].name.empty()) continue;
    const Lattice low = boxes[b].low, high = boxes[b].high;
    forEachPoint(low, high, [&](const Lattice& at) {
      const int node = nodes.at(at);
      mesh.groups[blocks[b].name].push_back(node);
      for (int axis = 0; axis < 3; ++axis) {
        const std::string side = blocks[b].name + "." + axisNames[axis];
        if (at[axis] == low[axis]) mesh.groups[side + "_min"].push_back(node);
        if (at[axis] == high[axis]) mesh.groups[side + "_max"].push_back(node);
      }
    });
  }
  return mesh;
}

}  // namespace pliant::geometry
