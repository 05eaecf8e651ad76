#include "core/interlock/handle_cycles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "core/interlock/linking_number.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXi;
using Eigen::Vector3d;

/// How far loops are moved outwards, over the size of the mesh: far more than rounding, far less than any edge.
constexpr double outwards = 1e-7;

/// A spanning tree, grown breadth first, of a graph whose edges join two nodes each.
class SpanningTree {
 public:
  /// `ends(e)`: the two nodes of edge e; edges with allowed[e] false are not used.
  template <class Ends>
  SpanningTree(int nodeCount, int edgeCount, const std::vector<bool>& allowed, Ends&& ends)
      : parent_(static_cast<std::size_t>(nodeCount), -1),
        edge_(static_cast<std::size_t>(nodeCount), -1),
        depth_(static_cast<std::size_t>(nodeCount), -1),
        uses_(static_cast<std::size_t>(edgeCount), false) {
    std::vector<std::vector<std::array<int, 2>>> neighbours(static_cast<std::size_t>(nodeCount));
    for (int e = 0; e < edgeCount; ++e) {
      if (!allowed[e]) continue;
      const auto [a, b] = ends(e);
      neighbours[a].push_back({b, e});
      neighbours[b].push_back({a, e});
    }
    int root = 0;
    while (neighbours[root].empty()) ++root;
    std::deque<int> queue{root};
    depth_[root] = 0;
    while (!queue.empty()) {
      const int at = queue.front();
      queue.pop_front();
      for (const auto& [next, e] : neighbours[at]) {
        if (depth_[next] >= 0) continue;
        parent_[next] = at;
        edge_[next] = e;
        depth_[next] = depth_[at] + 1;
        uses_[e] = true;
        queue.push_back(next);
      }
    }
  }

  bool uses(int edge) const { return uses_[edge]; }

  /// The nodes from one to the other, both included, and the edges between them.
  struct Path {
    std::vector<int> nodes, edges;
  };
  Path path(int from, int to) const {
    Path ahead, back;
    while (from != to) {
      const bool fromIsDeeper = depth_[from] >= depth_[to];
      Path& half = fromIsDeeper ? ahead : back;
      int& at = fromIsDeeper ? from : to;
      half.nodes.push_back(at);
      half.edges.push_back(edge_[at]);
      at = parent_[at];
    }
    ahead.nodes.push_back(from);
    ahead.nodes.insert(ahead.nodes.end(), back.nodes.rbegin(), back.nodes.rend());
    ahead.edges.insert(ahead.edges.end(), back.edges.rbegin(), back.edges.rend());
    return ahead;
  }

 private:
  std::vector<int> parent_, edge_, depth_;
  std::vector<bool> uses_;
};

Matrix3Xd polygonOf(const std::vector<Vector3d>& points) {
  Matrix3Xd polygon(3, static_cast<Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) polygon.col(static_cast<Index>(i)) = points[i];
  return polygon;
}

/// Brings the matrix to echelon form by integer row operations (Euclid's algorithm in each column), which are done to
/// `combinations` as well. Returns the rank.
int reduceRows(MatrixXi& matrix, MatrixXi& combinations) {
  int rank = 0;
  for (Index column = 0; column < matrix.cols() && rank < matrix.rows(); ++column)
    while (true) {
      int pivot = -1, others = 0;
      for (int row = rank; row < matrix.rows(); ++row) {
        if (matrix(row, column) == 0) continue;
        ++others;
        if (pivot < 0 || std::abs(matrix(row, column)) < std::abs(matrix(pivot, column))) pivot = row;
      }
      if (pivot < 0) break;
      matrix.row(rank).swap(matrix.row(pivot));
      combinations.row(rank).swap(combinations.row(pivot));
      if (others == 1) {
        ++rank;
        break;
      }
      for (int row = rank + 1; row < matrix.rows(); ++row) {
        const int times = matrix(row, column) / matrix(rank, column);
        matrix.row(row) -= times * matrix.row(rank);
        combinations.row(row) -= times * combinations.row(rank);
      }
    }
  return rank;
}

/// As described for handleCycles.
bool runsBackwards(const Cycle& cycle) {
  Vector3d area = Vector3d::Zero();
  double size = 0;
  for (const Matrix3Xd& polygon : cycle)
    for (Index i = 0; i < polygon.cols(); ++i) {
      const Vector3d from = polygon.col(i), to = polygon.col((i + 1) % polygon.cols());
      area += 0.5 * from.cross(to);
      size += 0.5 * from.cross(to).norm();
    }
  const double largest = area.cwiseAbs().maxCoeff();
  for (int axis = 2; axis >= 0; --axis)  // of equal ones the last, so that rounding does not decide
    if (std::abs(area[axis]) > largest - 1e-6 * size) return area[axis] < 0;
  return false;
}

}  // namespace

std::vector<Cycle> handleCycles(const geometry::SurfaceMesh& mesh) {
  const std::vector<geometry::MeshEdge> edges = geometry::meshEdges(mesh.triangles);
  const int edgeCount = static_cast<int>(edges.size()), triangleCount = static_cast<int>(mesh.triangles.size());
  std::vector<bool> allowed(edges.size(), true);
  const SpanningTree tree(
      static_cast<int>(mesh.points.cols()), edgeCount, allowed, [&](int e) { return edges[e].nodes; });
  for (int e = 0; e < edgeCount; ++e) allowed[e] = !tree.uses(e);
  const SpanningTree cotree(triangleCount, edgeCount, allowed, [&](int e) { return edges[e].triangles; });

  const double distance = outwards * (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  const auto corner = [&](int node) -> Vector3d { return mesh.points.col(node); };
  const auto normal = [&](int t) -> Vector3d {
    const auto& [a, b, c] = mesh.triangles[t];
    return (corner(b) - corner(a)).cross(corner(c) - corner(a)).normalized();
  };
  std::vector<Matrix3Xd> loops, raised;  // of the surface: along edges, and across them from triangle to triangle
  for (int e = 0; e < edgeCount; ++e) {
    if (tree.uses(e) || cotree.uses(e)) continue;
    std::vector<Vector3d> points;
    for (const int node : tree.path(edges[e].nodes[0], edges[e].nodes[1]).nodes) points.push_back(corner(node));
    loops.push_back(polygonOf(points));
    auto [nodes, crossed] = cotree.path(edges[e].triangles[0], edges[e].triangles[1]);
    crossed.push_back(e);
    points.clear();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      // Segments of a triangle stay above its plane.
      const auto& [a, b, c] = mesh.triangles[nodes[i]];
      points.push_back((corner(a) + corner(b) + corner(c)) / 3 + distance * normal(nodes[i]));
      const auto& [from, to] = edges[crossed[i]].nodes;
      const auto& [left, right] = edges[crossed[i]].triangles;
      points.push_back(0.5 * (corner(from) + corner(to)) + distance * (normal(left) + normal(right)).normalized());
    }
    raised.push_back(polygonOf(points));
  }

  const int count = static_cast<int>(loops.size());
  MatrixXi numbers(count, count), combinations = MatrixXi::Identity(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const auto number = linkingNumber(loops[i], raised[j]);
      if (!number) throw std::logic_error("loops of a solid mesh meet its surface");
      numbers(i, j) = *number;
    }
  const int handles = reduceRows(numbers, combinations);
  std::vector<Cycle> cycles(static_cast<std::size_t>(handles));
  for (int k = 0; k < handles; ++k) {
    for (int i = 0; i < count; ++i)
      for (int times = 0; times < std::abs(combinations(k, i)); ++times)
        cycles[k].push_back(combinations(k, i) > 0 ? loops[i] : Matrix3Xd(loops[i].rowwise().reverse()));
    if (runsBackwards(cycles[k]))
      for (Matrix3Xd& polygon : cycles[k]) polygon = polygon.rowwise().reverse().eval();
  }
  return cycles;
}

}  // namespace pliant::interlock
