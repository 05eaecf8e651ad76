#pragma once

#include <span>
#include <vector>

#include "core/interlock/dilated_piece.hpp"

namespace pliant::interlock {

/// What contact is computed between: a short arc of a curve, a point, a segment or a triangle.
enum class PartKind { arc, point, segment, triangle };

struct Part {
  PartKind kind;
  int piece;                     ///< of the shape
  double radius;                 ///< [m]
  int curve = -1;                ///< arc: index in ElementParts::curves
  double begin = 0, end = 0;     ///< arc: its parameters
  double sagitta = 0;            ///< arc: no point of it is farther from its chord [m]
  double chord = 0;              ///< arc: distance of its ends [m]
  double secondBound = 0;        ///< arc: bound of |c''| [m]
  std::array<int, 3> corners{};  ///< else: columns of ElementParts::corners; of an arc: those of its ends
  bool bounds = false;           ///< point of a segment or triangle, side of a triangle
};

/// A ball around several parts [m].
struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

/// A shape cut into parts, and a tree of balls around them, in the shape's coordinates.
class ElementParts {
 public:
  /// Arcs turn by at most `arcTurn` [rad].
  ElementParts(const ElementShape& shape, double arcTurn);

  struct Node {
    Ball ball;
    int part;                     ///< leaf: index in parts(), else -1
    std::array<int, 2> children;  ///< else: indices in nodes()
  };

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<ClosedCurve>& curves() const { return curves_; }
  const Eigen::Matrix3Xd& corners() const { return corners_; }
  /// The first is the root.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Of the nodes' balls, in columns.
  const Eigen::Matrix3Xd& centres() const { return centres_; }
  /// No point of the element is farther from its origin [m].
  double reach() const { return reach_; }

 private:
  void addCurve(const ClosedCurve& curve, int piece, double radius, double arcTurn);
  void addSimplices(const SimplexSet& set, int piece, double radius);
  Ball ballOf(const Part& part) const;
  int build(std::span<int> order, const std::vector<Ball>& balls);

  std::vector<Part> parts_;
  std::vector<ClosedCurve> curves_;
  Eigen::Matrix3Xd corners_;
  std::vector<Node> nodes_;
  Eigen::Matrix3Xd centres_;
  double reach_ = 0;
};

/// Whether the distance of two such parts counts. Others are left out because their parts' parts are there: two
/// triangles touch at a corner of one or at a side of each.
bool countsAsContact(const Part& a, const Part& b);

}  // namespace pliant::interlock
