#pragma once

#include <memory>
#include <optional>

#include "core/interlock/cell_equilibrium.hpp"

namespace pliant::interlock {

/// A place of the material that a hand can take: see ElementPull. The first element with no arm and a shift is the cell
/// itself.
struct CellGrip {
  int element = 0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();    ///< in the shape's coordinates [m]
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< lattice vectors
};

/// Where two elements hold each other; forces of neighbouring parts that are one contact are added up.
struct LiveContact {
  int a = 0, b = 0;
  std::array<int, 2> shift{};  ///< lattice vectors by which b is moved
  Eigen::Vector3d place;       ///< midway between the surfaces [m]
  double gap = 0;              ///< [m]
  double force = 0;            ///< [1/m]
};

/// What came of one LiveCell::advance.
struct LiveStep {
  base::TerminationType termination = base::TerminationType::converged;
  std::string message;  ///< one sentence if it failed
  /// The hand has what it wants, or contacts hold it back, or there is none: further steps change nothing.
  bool settled = true;
  /// Contacts hold the place back from the hand.
  bool locked = false;
  double missing = 0;                 ///< from the place to the hand [m]
  std::vector<LiveContact> contacts;  ///< that push, the strongest first
  double smallestGap = 0;             ///< of all elements [m], at most twice the smallest radius

  bool failed() const {
    return termination != base::TerminationType::converged && termination != base::TerminationType::cancelled;
  }
};

/// A cell that a hand pulls while somebody watches. The place that is held is drawn to the hand by a spring of bounded
/// force, contacts hold (see CellSolver), and all else stays where it is unless it is pushed: a weak spring holds
/// strain and elements to where they were when a step began. Without a hand nothing moves. Whatever the hand does,
/// elements never overlap and linking numbers stay.
class LiveCell {
 public:
  /// At rest. The cell must have passed checkCell.
  explicit LiveCell(const UnitCell& cell);

  const UnitCell& cell() const { return solver_.contact().cell(); }
  const CellState& state() const { return state_; }
  /// Of the grip, as the cell is now [m].
  Eigen::Vector3d placeOf(const CellGrip& grip) const;

  /// The hand takes the grip, or moves on with it, to `hand` [m] from the next step on. Throws base::InputError
  /// (location empty) if there is no such element or the hand is nowhere.
  void pull(const CellGrip& grip, const Eigen::Vector3d& hand);
  void letGo() { held_.reset(); }
  bool isPulled() const { return held_.has_value(); }
  /// As it was in the beginning, without a hand.
  void reset();

  /// One step towards the hand: a solve that ends where contact and hand are in balance, or at once where it is
  /// cancelled; what has been done until then stays.
  LiveStep advance(const base::ExecutionContext* context = nullptr);

 private:
  struct Held {
    CellGrip grip;
    Eigen::Vector3d hand;
  };
  ElementPull pullOf(const Held& held) const;

  CellSolver solver_;
  double length_;  ///< of the lattice [m]
  CellState state_;
  std::optional<Held> held_;
};

}  // namespace pliant::interlock
