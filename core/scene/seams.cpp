#include "core/scene/seams.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

/// Nodes of the scene in the order in which they follow each other along the boundary of a geometry.
struct SewnEdge {
  std::vector<int> nodes;
  bool closed = false;
};

class Sewing {
 public:
  explicit Sewing(std::vector<PlacedGeometry>& geometries) : geometries_(geometries) {
    const PlacedGeometry& last = geometries.back();
    first_.resize(static_cast<std::size_t>(last.firstNode) + static_cast<std::size_t>(last.ownCount));
    std::iota(first_.begin(), first_.end(), 0);
  }

  void sew(const Json& seam, const std::string& pointer) {
    const SewnEdge from = edgeOf(seam["from"], pointer + "/from"), to = edgeOf(seam["to"], pointer + "/to");
    if (from.nodes.size() != to.nodes.size())
      throw InputError(pointer, "Sewn edges need as many nodes as each other, but these have " +
                                    std::to_string(from.nodes.size()) + " and " + std::to_string(to.nodes.size()) +
                                    "; mesh both edges alike.");
    if (from.closed != to.closed) throw InputError(pointer, "One of these edges is closed and the other is not.");
    for (const int node : from.nodes)
      if (std::find(to.nodes.begin(), to.nodes.end(), node) != to.nodes.end())
        throw InputError(pointer, nodeText(node) + " is on both edges and would be sewn to itself.");
    const std::vector<int> partners = partnersOf(from, to, seam["reverse"]);
    for (std::size_t i = 0; i < partners.size(); ++i) {
      const int a = firstOf(from.nodes[i]), b = firstOf(partners[i]);
      first_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }

  /// Moves sewn nodes to their middle, and counts nodes anew.
  void finish() {
    std::vector<Eigen::Vector3d> sum(first_.size(), Eigen::Vector3d::Zero());
    std::vector<int> members(first_.size(), 0), number(first_.size(), -1);
    forEachNode([&](PlacedGeometry& geometry, int local, int node) {
      sum[static_cast<std::size_t>(firstOf(node))] += geometry.mesh.points.col(local);
      ++members[static_cast<std::size_t>(firstOf(node))];
    });
    int count = 0;
    for (PlacedGeometry& geometry : geometries_) {
      geometry.firstNode = count;
      for (int local = 0; local < geometry.nodeCount(); ++local) {
        int& node = geometry.nodes[static_cast<std::size_t>(local)];
        const auto first = static_cast<std::size_t>(firstOf(node));
        if (members[first] > 1) geometry.mesh.points.col(local) = sum[first] / members[first];
        if (number[first] < 0) number[first] = count++;
        node = number[first];
      }
      geometry.ownCount = count - geometry.firstNode;
    }
    checkTriangles();
  }

 private:
  template <class Body>
  void forEachNode(const Body& body) {
    for (PlacedGeometry& geometry : geometries_)
      for (int local = 0; local < geometry.nodeCount(); ++local)
        body(geometry, local, geometry.nodes[static_cast<std::size_t>(local)]);
  }

  int firstOf(int node) const {
    while (first_[static_cast<std::size_t>(node)] != node) node = first_[static_cast<std::size_t>(node)];
    return node;
  }

  /// Before nodes are counted anew.
  const PlacedGeometry& geometryOf(int node) const {
    return *std::find_if(geometries_.begin(), geometries_.end(),
                         [&](const PlacedGeometry& g) { return node < g.firstNode + g.ownCount; });
  }

  Eigen::Vector3d placeOf(int node) const {
    const PlacedGeometry& geometry = geometryOf(node);
    return geometry.unsewn.col(node - geometry.firstNode);
  }

  std::string nodeText(int node) const {
    const PlacedGeometry& geometry = geometryOf(node);
    return "Node " + std::to_string(node - geometry.firstNode) + " of the geometry " + quote(geometry.name);
  }

  SewnEdge edgeOf(const Json& selection, const std::string& pointer) const {
    const std::vector<int> chosen = selectNodes(selection, pointer, geometries_);
    if (chosen.size() < 2) throw InputError(pointer, "A sewn edge has two nodes at least, but here is one.");
    const PlacedGeometry& geometry = geometryOf(chosen.front());
    std::map<int, std::vector<int>> neighbours;
    for (const int node : chosen) neighbours[node];
    for (const geometry::MeshEdge& side : geometry::meshEdges(geometry.global(geometry.mesh.triangles))) {
      const auto [a, b] = side.nodes;
      if (side.triangles[1] >= 0 || !neighbours.contains(a) || !neighbours.contains(b)) continue;
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
    const auto end =
        std::find_if(neighbours.begin(), neighbours.end(), [](const auto& entry) { return entry.second.size() == 1; });
    SewnEdge edge;
    edge.closed = end == neighbours.end();
    int previous = -1, node = edge.closed ? chosen.front() : end->first;
    while (node >= 0) {
      edge.nodes.push_back(node);
      int next = -1;
      for (const int other : neighbours[node])
        if (other != previous && other != edge.nodes.front() && next < 0) next = other;
      previous = std::exchange(node, edge.nodes.size() < chosen.size() ? next : -1);
    }
    for (const int other : chosen)
      if (std::find(edge.nodes.begin(), edge.nodes.end(), other) == edge.nodes.end())
        throw InputError(pointer, "These " + std::to_string(chosen.size()) + " nodes are not one connected piece of " +
                                      "the boundary: from node " +
                                      std::to_string(edge.nodes.front() - geometry.firstNode) + " of the geometry " +
                                      quote(geometry.name) + " no way along it leads to node " +
                                      std::to_string(other - geometry.firstNode) + ".");
    return edge;
  }

  /// For each node of one edge the one of the other that it is sewn to. Of the ways to lay one along the other,
  /// forwards or backwards and, if they are closed, from any node on, the one with the smallest sum of squared
  /// distances; if `reverse`, the best in the other direction.
  std::vector<int> partnersOf(const SewnEdge& from, const SewnEdge& to, bool reverse) const {
    const std::size_t count = from.nodes.size();
    std::array<std::vector<int>, 2> best;
    std::array<double, 2> smallest = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (const std::size_t backwards : {0u, 1u})
      for (std::size_t shift = 0; shift < (to.closed ? count : 1); ++shift) {
        std::vector<int> partners;
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
          partners.push_back(to.nodes[(shift + (backwards ? count - 1 - i : i)) % count]);
          sum += (placeOf(from.nodes[i]) - placeOf(partners.back())).squaredNorm();
        }
        if (sum < smallest[backwards]) {
          smallest[backwards] = sum;
          best[backwards] = std::move(partners);
        }
      }
    return best[(smallest[1] < smallest[0]) != reverse ? 1 : 0];
  }

  void checkTriangles() const {
    std::vector<std::array<int, 3>> all;
    for (const PlacedGeometry& geometry : geometries_) {
      const auto triangles = geometry.global(geometry.mesh.triangles);
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        all.push_back(triangles[t]);
        const auto& [a, b, c] = triangles[t];
        if (a == b || b == c || c == a)
          throw InputError("", "corners of triangle " + std::to_string(t) + " of the geometry " + quote(geometry.name) +
                                   " would be sewn together");
      }
    }
    geometry::meshEdges(all);  // throws where three triangles share an edge
  }

  std::vector<PlacedGeometry>& geometries_;
  std::vector<int> first_;  ///< of nodes that are one: a lower one, or itself
};

}  // namespace

void sewSeams(const Json& seams, std::vector<PlacedGeometry>& geometries) {
  if (seams.empty()) return;
  Sewing sewing(geometries);
  for (std::size_t i = 0; i < seams.size(); ++i) sewing.sew(seams[i], childPointer("/seams", i));
  locate("/seams", [&] { sewing.finish(); });
}

}  // namespace pliant::scene
