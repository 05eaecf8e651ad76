#pragma once

#include <map>

#include "core/cloth/cloth_simulation.hpp"

namespace pliant::cloth {

/// Nodes of a simulation that a hand pulls. A pulled node goes towards the hand, by at most four of the sheet's extents
/// in a second of simulated time. Where limits, pins and hands contradict each other no step is possible: the pulled
/// nodes then stay where they are while the rest moves on, and try again in ever longer intervals and shorter paths, so
/// that a hand that pulls too far costs little. Where nothing can move on either, pulled nodes give way a little and
/// the sheet starts from rest.
class Dragging {
 public:
  /// The simulation must outlive this.
  explicit Dragging(ClothSimulation& simulation);

  /// `node` goes towards `hand` [m] from the next step on. Throws base::InputError (location empty) if there is no such
  /// node or the hand is nowhere.
  void pull(int node, const Eigen::Vector3d& hand);
  /// The hand opens: a node that nothing else holds is free again, one that a pin holds or that is to `stay` is held
  /// where it is.
  void letGo(int node, bool stay);
  /// One step. If it is not done even with all pulled nodes at rest, the state is still that before.
  StepRecord step(base::ExecutionContext& context);

  /// Pulled nodes and nodes that stay where a hand put them, with where they are to go [m].
  const std::map<int, Eigen::Vector3d>& hands() const { return hands_; }
  /// Why pulled nodes could not go on in the last steps; empty if they can.
  const std::string& obstacle() const { return obstacle_; }
  /// How far a pulled node gets in one step at most [m].
  double reach() const { return reach_; }

 private:
  void aim(double fraction);
  bool isPulled() const;

  ClothSimulation& simulation_;
  std::map<int, Eigen::Vector3d> hands_;
  double reach_;
  int refusals_ = 0;  ///< in a row, at most `mostRefusals`
  int pause_ = 0;     ///< steps before pulled nodes try to move again
  std::string obstacle_;
};

}  // namespace pliant::cloth
