#include "ui/viewport/sheet_brush.hpp"

#include <algorithm>
#include <cmath>

#include "ui/render/macro_view.hpp"

namespace pliant::viewport {

SheetBrush::SheetBrush(std::shared_ptr<render::MacroView> view, QObject* parent)
    : QObject(parent), view_(std::move(view)) {}

bool SheetBrush::press(double x, double y, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  if (button != Qt::LeftButton || (modifiers & Qt::ShiftModifier) || !view_->triangleAt(x, y)) return false;
  wipes_ = modifiers & Qt::ControlModifier;
  stroke_.clear();
  pixels_ = view_->trianglePixels();
  touch(x, y);
  return true;
}

/// Quick drags leave no gaps.
void SheetBrush::drag(double x, double y) {
  const double fromX = x_, fromY = y_, way = std::hypot(x - fromX, y - fromY);
  const int steps = std::max(1, static_cast<int>(std::ceil(way / radius_)));
  for (int i = 1; i <= steps; ++i) touch(fromX + (x - fromX) * i / steps, fromY + (y - fromY) * i / steps);
}

void SheetBrush::touch(double x, double y) {
  x_ = x;
  y_ = y;
  const std::size_t before = stroke_.size();
  if (const auto hit = view_->triangleAt(x, y)) stroke_.insert(*hit);
  for (Eigen::Index t = 0; t < pixels_.cols(); ++t)
    if ((pixels_.col(t) - Eigen::Vector2d(x, y)).norm() <= radius_) stroke_.insert(static_cast<int>(t));
  if (stroke_.size() > before) Q_EMIT strokeGrows({stroke_.begin(), stroke_.end()}, wipes_);
}

void SheetBrush::release() {
  const std::vector<int> stroke(stroke_.begin(), stroke_.end());
  stroke_.clear();
  if (!stroke.empty()) Q_EMIT strokeEnded(stroke, wipes_);
}

bool SheetBrush::hover(double x, double y) { return view_->triangleAt(x, y).has_value(); }

bool SheetBrush::escape() {
  if (stroke_.empty()) return false;
  stroke_.clear();
  Q_EMIT strokeGrows({}, wipes_);
  return true;
}

}  // namespace pliant::viewport
