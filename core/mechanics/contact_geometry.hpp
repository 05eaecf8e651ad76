#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/geometry/box_tree.hpp"
#include "core/geometry/simplex_distance.hpp"

namespace pliant::mechanics {

/// What can touch. Nodes are numbered through: first the deformable ones (body 0), then those of bodies whose motion is
/// given. A primitive stands for all points within its radius: an extra point is a sphere, an extra edge a capsule.
/// The nodes of one primitive belong to one body and have one radius.
struct ContactGeometry {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;  ///< besides the sides of triangles
  std::vector<int> points;                ///< besides the ends of edges
  std::vector<double> radii;              ///< [m], one a node
  /// One a node. Deformable nodes (0) may collide with everything; others with deformable ones only.
  std::vector<int> bodies;
  bool selfContact = true;  ///< whether deformable nodes may collide with themselves

  int nodeCount() const { return static_cast<int>(bodies.size()); }
};

/// Throws base::InputError (location empty) with a sentence that names the node or primitive: lists of different
/// length, radii that are negative or not finite, deformable nodes behind others, indices out of range, a primitive
/// that names a node twice or has nodes of different bodies or radii.
void checkContactGeometry(const ContactGeometry& geometry);

/// Two primitives that share no node and of which one at least is deformable.
struct ContactPair {
  geometry::SimplexPair kind = geometry::SimplexPair::pointPoint;
  std::array<int, 4> nodes = {-1, -1, -1, -1};  ///< as many as `kind` has corners

  bool operator==(const ContactPair&) const = default;
  bool operator<(const ContactPair& other) const {
    return kind != other.kind ? kind < other.kind : nodes < other.nodes;
  }
};

/// "node 3 and the triangle of nodes 4, 5 and 6"
std::string nameOf(const ContactPair& pair);

/// The primitives of a geometry, and which pairs of them come near each other. Pairs are
/// - every node in use with every triangle, and every edge with every edge, which is enough for triangles;
/// - every node in use with every extra edge: between parallel edges the pair of edges alone would exert no force
///   (see geometry::edgeMollifier);
/// - extra points that belong to no edge with each other.
class ContactPrimitives {
 public:
  /// Throws as checkContactGeometry.
  explicit ContactPrimitives(ContactGeometry geometry);

  const ContactGeometry& geometry() const { return geometry_; }
  int deformableCount() const { return deformableCount_; }

  /// All pairs that might come as near as `reach` [m] beyond their radii while nodes move on straight lines between
  /// `from` and `to` (3 x nodeCount() [m]), and some more. In an order that depends on the positions alone.
  std::vector<ContactPair> nearPairs(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double reach) const;

  /// Sum of the radii of both primitives [m].
  double radiiOf(const ContactPair& pair) const {
    return geometry_.radii[pair.nodes[0]] + geometry_.radii[pair.nodes[geometry::cornerCount(pair.kind) - 1]];
  }

 private:
  /// Primitives of one kind, deformable ones and others; missing nodes repeat the last.
  using Nodes = std::array<int, 3>;
  using Family = std::array<std::vector<Nodes>, 2>;
  using Trees = std::array<geometry::BoxTree, 2>;

  void add(Family& family, const Nodes& nodes) { family[geometry_.bodies[nodes[0]] == 0 ? 0 : 1].push_back(nodes); }
  Trees treesOf(const Family& family, const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double reach) const;

  ContactGeometry geometry_;
  int deformableCount_ = 0;
  Family points_, lonePoints_, edges_, extraEdges_, triangles_;
};

}  // namespace pliant::mechanics
