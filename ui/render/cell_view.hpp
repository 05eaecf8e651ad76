#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/interlock/cell_inspection.hpp"
#include "core/interlock/live_cell.hpp"
#include "ui/render/cell_patch.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// An interlocking material at its native scale: one cell with its neighbours around it, which are paler, the outline
/// of the patch with handles at its corners and sides, and where elements push each other. A place can be marked where
/// elements overlap. It only draws; states come from outside.
class CellView final : public View {
 public:
  CellView();
  ~CellView() override;

  /// Shows a cell at rest. Null: an empty view.
  void setCell(std::shared_ptr<const interlock::UnitCell> cell);
  const std::shared_ptr<const interlock::UnitCell>& cell() const;
  /// Where its elements are, and the contacts that push.
  void setState(const interlock::CellState& state, const std::vector<interlock::LiveContact>& contacts);
  const interlock::CellState& state() const;
  /// Marks where elements overlap.
  void setOverlap(std::optional<interlock::NearestElements> overlap);
  /// A place that is held, and the hand [m].
  void setHand(std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> hand);
  void setHandlesVisible(bool visible);

  /// Handles come before elements, and of these the one in front. Pixels count from the top left.
  std::optional<CellPick> pick(double x, double y, double radius) const;
  /// Where a hand is that takes `picked` at the pixel (x, y): handles stay in their plane, anything else in the plane
  /// that faces the camera.
  std::optional<Eigen::Vector3d> handAt(const CellPick& picked, double x, double y) const;
  /// Of the corners and sides of the patch, in turn: where they are [m].
  std::vector<CellPick> handles() const;
  /// From the bottom left of the window.
  std::optional<Eigen::Vector2d> pixelOf(const Eigen::Vector3d& point) const;

  std::optional<int> pickNode(double, double, double) const override { return std::nullopt; }

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
