#pragma once

#include <functional>
#include <optional>

#include "ui/render/points.hpp"
#include "ui/viewport/mouse_tool.hpp"

namespace pliant::render {
class MotionView;
}

namespace pliant::viewport {

/// Draws a closed curve through points in a plane: points are dragged, a press beside the curve's points on the curve
/// makes a new one, and a right click (or Ctrl and a left one) on a point removes it as long as three remain.
class TargetTool final : public MouseTool {
 public:
  enum class Edit { moved, added, removed };

  explicit TargetTool(const render::MotionView& view) : view_(view) {}

  /// What is drawn, the plane that it is drawn in (through each of its points), and the curve's points, as many between
  /// each two of `points`.
  void set(render::Points points, const Eigen::Vector3d& normal);
  void setCurve(render::Points curve) { curve_ = std::move(curve); }
  const render::Points& points() const { return points_; }
  /// The point under the mouse; -1: none.
  int active() const { return active_; }
  bool isDragging() const { return dragging_; }

  std::function<void()> onChanged;        ///< points, or which one is under the mouse
  std::function<void(Edit)> onCommitted;  ///< the mouse was let go
  std::function<void()> onEnded;          ///< Escape

  bool press(double x, double y, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) override;
  void drag(double x, double y) override;
  void release() override;
  bool hover(double x, double y) override;
  bool escape() override;

 private:
  std::optional<int> pointAt(double x, double y) const;
  /// The piece of the curve there, by the number of the point before it.
  std::optional<int> pieceAt(double x, double y) const;
  std::optional<Eigen::Vector3d> placeInPlane(const Eigen::Vector3d& through, double x, double y) const;
  void removePoint(int index);

  const render::MotionView& view_;
  render::Points points_{3, 0}, curve_{3, 0}, before_{3, 0};
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  int active_ = -1;
  bool dragging_ = false;
  Edit edit_ = Edit::moved;
};

}  // namespace pliant::viewport
