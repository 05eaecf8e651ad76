#include "ui/viewport/target_tool.hpp"

#include <cmath>
#include <utility>

#include "ui/render/camera_control.hpp"
#include "ui/render/motion_view.hpp"

namespace pliant::viewport {
namespace {

constexpr double pointRadius = 10, curveRadius = 7;  // pixels
constexpr Eigen::Index fewestPoints = 3;

}  // namespace

using render::Points;

void TargetTool::set(Points points, const Eigen::Vector3d& normal) {
  points_ = std::move(points);
  normal_ = normal.normalized();
  active_ = -1;
  dragging_ = false;
}

std::optional<int> TargetTool::pointAt(double x, double y) const {
  return view_.camera().nearestPoint(points_, x, y, pointRadius);
}

std::optional<int> TargetTool::pieceAt(double x, double y) const {
  const auto hit = view_.camera().nearestPoint(curve_, x, y, curveRadius);
  if (!hit || points_.cols() == 0) return std::nullopt;
  return static_cast<int>(*hit / (curve_.cols() / points_.cols()));
}

std::optional<Eigen::Vector3d> TargetTool::placeInPlane(const Eigen::Vector3d& through, double x, double y) const {
  const auto beside = view_.camera().pointBeside(through, x, y);
  if (!beside) return std::nullopt;
  const Eigen::Vector3d eye = view_.cameraPose().position, ray = (*beside - eye).normalized();
  const double slope = ray.dot(normal_);
  // Seen from its edge the plane gives no place; then the one that faces the camera does.
  if (std::abs(slope) < 0.1) return beside;
  return Eigen::Vector3d(eye + (through - eye).dot(normal_) / slope * ray);
}

bool TargetTool::press(double x, double y, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  if (button == Qt::MiddleButton || (modifiers & Qt::ShiftModifier)) return false;
  const auto point = pointAt(x, y);
  const bool removes = button == Qt::RightButton || (modifiers & Qt::ControlModifier);
  before_ = points_;
  if (removes) {
    if (!point || points_.cols() <= fewestPoints) return false;
    removePoint(*point);
    return true;
  }
  edit_ = Edit::moved;
  if (point) {
    active_ = *point;
  } else if (const auto piece = pieceAt(x, y)) {
    const auto hit = view_.camera().nearestPoint(curve_, x, y, curveRadius);
    Points more(3, points_.cols() + 1);
    more << points_.leftCols(*piece + 1), curve_.col(*hit), points_.rightCols(points_.cols() - *piece - 1);
    points_ = std::move(more);
    active_ = *piece + 1;
    edit_ = Edit::added;
  } else {
    return false;
  }
  dragging_ = true;
  if (onChanged) onChanged();
  return true;
}

void TargetTool::removePoint(int index) {
  Points fewer(3, points_.cols() - 1);
  fewer << points_.leftCols(index), points_.rightCols(points_.cols() - index - 1);
  points_ = std::move(fewer);
  active_ = -1;
  edit_ = Edit::removed;
  dragging_ = true;
  if (onChanged) onChanged();
}

void TargetTool::drag(double x, double y) {
  if (!dragging_ || active_ < 0) return;
  const auto place = placeInPlane(points_.col(active_), x, y);
  if (!place) return;
  points_.col(active_) = *place;
  if (onChanged) onChanged();
}

void TargetTool::release() {
  if (!std::exchange(dragging_, false)) return;
  const bool same = points_.cols() == before_.cols() && points_ == before_;
  if (!same && onCommitted) onCommitted(edit_);
}

bool TargetTool::hover(double x, double y) {
  const int under = pointAt(x, y).value_or(-1);
  if (under != active_) {
    active_ = under;
    if (onChanged) onChanged();
  }
  return under >= 0 || pieceAt(x, y);
}

bool TargetTool::escape() {
  if (dragging_) {
    dragging_ = false;
    points_ = before_;
    active_ = -1;
    if (onChanged) onChanged();
  } else if (onEnded) {
    onEnded();
  }
  return true;
}

}  // namespace pliant::viewport
