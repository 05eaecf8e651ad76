#include "core/mechanics/contact_geometry.hpp"

#include <algorithm>
#include <span>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

using geometry::SimplexPair;

/// "node 3", "the edge between nodes 3 and 4", "the triangle of nodes 3, 4 and 5"
std::string nameOfPrimitive(std::span<const int> nodes) {
  const auto text = [&](int i) { return std::to_string(nodes[i]); };
  if (nodes.size() == 1) return "node " + text(0);
  if (nodes.size() == 2) return "the edge between nodes " + text(0) + " and " + text(1);
  return "the triangle of nodes " + text(0) + ", " + text(1) + " and " + text(2);
}

void checkContactPrimitive(const ContactGeometry& geometry, std::span<const int> nodes) {
  const std::string name = nameOfPrimitive(nodes);
  for (const int node : nodes) {
    if (node < 0 || node >= geometry.nodeCount())
      throw base::InputError("", name + " cannot touch anything: nodes are numbered from 0 to " +
                                     std::to_string(geometry.nodeCount() - 1));
    if (std::count(nodes.begin(), nodes.end(), node) > 1)
      throw base::InputError("", name + " has one node twice, but all must be different");
    if (geometry.bodies[node] != geometry.bodies[nodes[0]])
      throw base::InputError("", name + " joins two bodies, but must belong to one");
    if (geometry.radii[node] != geometry.radii[nodes[0]])
      throw base::InputError("", name + " has nodes of different radii, but must have one radius");
  }
}

bool sharesNode(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (const int node : a)
    if (node == b[0] || node == b[1] || node == b[2]) return true;
  return false;
}

}  // namespace

void checkContactGeometry(const ContactGeometry& geometry) {
  if (geometry.radii.size() != geometry.bodies.size())
    throw base::InputError("", "there are " + std::to_string(geometry.radii.size()) + " contact radii, but " +
                                   std::to_string(geometry.bodies.size()) + " nodes");
  for (int node = 0; node < geometry.nodeCount(); ++node) {
    requireNotNegative(geometry.radii[node], "the contact radius of node " + std::to_string(node));
    if (node > 0 && geometry.bodies[node] == 0 && geometry.bodies[node - 1] != 0)
      throw base::InputError("", "node " + std::to_string(node) +
                                     " is deformable and follows the node of a body, but deformable nodes come first");
  }
  for (const int& node : geometry.points) checkContactPrimitive(geometry, {&node, 1});
  for (const auto& edge : geometry.edges) checkContactPrimitive(geometry, edge);
  for (const auto& triangle : geometry.triangles) checkContactPrimitive(geometry, triangle);
}

std::string nameOf(const ContactPair& pair) {
  const int first = geometry::firstCornerCount(pair.kind), all = geometry::cornerCount(pair.kind);
  const std::span nodes(pair.nodes);
  return nameOfPrimitive(nodes.first(first)) + " and " + nameOfPrimitive(nodes.subspan(first, all - first));
}

ContactPrimitives::ContactPrimitives(ContactGeometry geometry) : geometry_(std::move(geometry)) {
  checkContactGeometry(geometry_);
  deformableCount_ = static_cast<int>(std::count(geometry_.bodies.begin(), geometry_.bodies.end(), 0));

  std::vector<std::array<int, 2>> sides, extra;
  for (const auto& [a, b, c] : geometry_.triangles)
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      sides.push_back({std::min(from, to), std::max(from, to)});
  for (const auto& [from, to] : geometry_.edges) extra.push_back({std::min(from, to), std::max(from, to)});
  for (auto* edges : {&sides, &extra}) {
    std::sort(edges->begin(), edges->end());
    edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
  }
  std::erase_if(extra, [&](const auto& edge) { return std::binary_search(sides.begin(), sides.end(), edge); });

  std::vector<char> used(geometry_.nodeCount(), 0), onEdge(geometry_.nodeCount(), 0);
  for (const int node : geometry_.points) used[node] = 1;
  for (const auto* edges : {&sides, &extra})
    for (const auto& [from, to] : *edges) {
      add(edges_, {from, to, to});
      if (edges == &extra) add(extraEdges_, {from, to, to});
      used[from] = used[to] = onEdge[from] = onEdge[to] = 1;
    }
  for (const auto& triangle : geometry_.triangles) add(triangles_, triangle);
  for (int node = 0; node < geometry_.nodeCount(); ++node) {
    if (used[node]) add(points_, {node, node, node});
    if (used[node] && !onEdge[node]) add(lonePoints_, {node, node, node});
  }
}

ContactPrimitives::Trees ContactPrimitives::treesOf(const Family& family, const Eigen::Matrix3Xd& from,
                                                    const Eigen::Matrix3Xd& to, double reach) const {
  Trees trees;
  std::vector<geometry::BoxTree::Box> boxes;
  for (int side = 0; side < 2; ++side) {
    boxes.assign(family[side].size(), {});
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (const int node : family[side][i]) boxes[i].extend(from.col(node)).extend(to.col(node));
      const double growth = geometry_.radii[family[side][i][0]] + 0.5 * reach;
      boxes[i].min().array() -= growth;
      boxes[i].max().array() += growth;
    }
    trees[side].build(boxes);
  }
  return trees;
}

std::vector<ContactPair> ContactPrimitives::nearPairs(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                                                      double reach) const {
  std::vector<ContactPair> pairs;
  /// All pairs of a primitive of `a` and one of `b`, but not both of bodies.
  const auto collect = [&](SimplexPair kind, const Family& a, const Trees& treesA, const Family& b,
                           const Trees& treesB) {
    const int first = geometry::firstCornerCount(kind), second = geometry::cornerCount(kind) - first;
    for (const auto& [sideA, sideB] : {std::array{0, 0}, std::array{0, 1}, std::array{1, 0}}) {
      const bool own = &a == &b;
      if (own && sideA == 1) continue;  // found the other way round
      if (sideA == 0 && sideB == 0 && !geometry_.selfContact) continue;
      const auto& primitivesA = a[sideA];
      const auto& primitivesB = b[sideB];
      const auto apart = [&](int i, int j) { return !sharesNode(primitivesA[i], primitivesB[j]); };
      const auto found = own && sideB == 0 ? treesA[0].ownPairs(apart) : treesA[sideA].pairsWith(treesB[sideB], apart);
      for (const auto& [i, j] : found) {
        ContactPair& pair = pairs.emplace_back();
        pair.kind = kind;
        std::copy_n(primitivesA[i].begin(), first, pair.nodes.begin());
        std::copy_n(primitivesB[j].begin(), second, pair.nodes.begin() + first);
      }
    }
  };
  const Trees points = treesOf(points_, from, to, reach), edges = treesOf(edges_, from, to, reach);
  const Trees lonePoints = treesOf(lonePoints_, from, to, reach), extraEdges = treesOf(extraEdges_, from, to, reach);
  const Trees triangles = treesOf(triangles_, from, to, reach);
  collect(SimplexPair::pointTriangle, points_, points, triangles_, triangles);
  collect(SimplexPair::edgeEdge, edges_, edges, edges_, edges);
  collect(SimplexPair::pointEdge, points_, points, extraEdges_, extraEdges);
  collect(SimplexPair::pointPoint, lonePoints_, lonePoints, lonePoints_, lonePoints);
  return pairs;
}

}  // namespace pliant::mechanics
