#pragma once

#include <memory>
#include <vector>

#include "core/interlock/live_cell.hpp"
#include "ui/render/points.hpp"

namespace pliant::render {

/// What of a cell is under the mouse.
struct CellPick {
  interlock::CellGrip grip;
  Eigen::Vector3d place;  ///< where it is now [m]
  bool handle = false;    ///< of the patch's outline, and not an element
};

/// A cell with its neighbours around it, at some state: where everything is.
class CellPatch {
 public:
  /// At rest; null: nothing. A very large cell has no neighbours.
  void setCell(std::shared_ptr<const interlock::UnitCell> cell);
  void setState(const interlock::CellState& state) { state_ = state; }

  const std::shared_ptr<const interlock::UnitCell>& cell() const { return cell_; }
  const interlock::CellState& state() const { return state_; }
  /// Neighbours on each side, 1 or 0.
  int neighbours() const { return neighbours_; }

  /// By how much the image `shift` is moved [m].
  Eigen::Vector3d translation(const std::array<int, 2>& shift) const;
  /// Of a place of an element's image, `arm` in its shape's coordinates [m].
  Eigen::Vector3d placeOf(int element, const std::array<int, 2>& shift, const Eigen::Vector3d& arm) const;
  /// The corners of the outline and the middles of its sides, in turn. The outline goes half a cell beyond the middles
  /// of the outer cells.
  std::vector<CellPick> handles() const;
  /// Of the outline, from corner to corner [m].
  double extent() const;
  /// Of every image of the contacts between elements that are there.
  std::vector<Eigen::Vector3d> places(const std::vector<interlock::LiveContact>& contacts) const;

 private:
  std::shared_ptr<const interlock::UnitCell> cell_;
  interlock::CellState state_;
  int neighbours_ = 1;
};

}  // namespace pliant::render
