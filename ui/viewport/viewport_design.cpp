#include "ui/render/motion_pair.hpp"
#include "ui/viewport/mouse_tool.hpp"
#include "ui/viewport/render_surface.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {

void Viewport::setGhost(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                        const QString& label) {
  motion_.setGhost(std::move(problem), z, label.toStdString());
  if (framed_) motion_.fit();
  redraw();
}

void Viewport::setBeside(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                         const QString& caption) {
  if (view_ != &motion_) return;
  const bool opens = !pair_;
  if (opens) {
    pair_ = std::make_unique<render::MotionPair>(motion_);
    pair_->setTheme(theme());
    pair_->setPixelRatio(devicePixelRatioF());
    pair_->right().setFieldVisible(motion_.fieldVisible());
    pair_->attach(surface_->window());
  }
  pair_->setRight(std::move(problem), z, caption.toStdString());
  if (framed_) motion_.fit();
  redraw();
}

void Viewport::clearBeside() {
  if (!pair_) return;
  pair_.reset();
  if (framed_) view_->fit();
  redraw();
}

void Viewport::setTool(MouseTool* tool) {
  tool_ = tool;
  toolHolds_ = false;
  setMouseTracking(tool_ || live_ || showsCell());
  if (!tool_) unsetCursor();
  redraw();
}

bool Viewport::pressTool(const QPointF& place, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  const double ratio = devicePixelRatioF();
  toolHolds_ = tool_ && view_ == &motion_ && tool_->press(place.x() * ratio, place.y() * ratio, button, modifiers);
  if (toolHolds_) setCursor(Qt::ClosedHandCursor);
  return toolHolds_;
}

void Viewport::dragTool(const QPointF& place) {
  const double ratio = devicePixelRatioF();
  tool_->drag(place.x() * ratio, place.y() * ratio);
}

void Viewport::releaseTool() {
  toolHolds_ = false;
  setCursor(Qt::OpenHandCursor);
  tool_->release();
}

void Viewport::hoverTool(const QPointF& place) {
  const double ratio = devicePixelRatioF();
  if (tool_->hover(place.x() * ratio, place.y() * ratio))
    setCursor(Qt::OpenHandCursor);
  else
    unsetCursor();
}

/// The half that is there, and the place in it [physical pixels].
std::pair<render::View&, QPointF> Viewport::halfAt(const QPointF& place) const {
  const QPointF pixel = place * devicePixelRatioF();
  if (!pair_ || pixel.x() < pair_->rightBegin()) return {*view_, pixel};
  return {pair_->right(), pixel - QPointF(pair_->rightBegin(), 0)};
}

}  // namespace pliant::viewport
