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
  refreshTools();
}

void Viewport::setGuestTool(MouseTool* tool) {
  if (tool == guestTool_) return;
  guestTool_ = tool;
  refreshTools();
}

MouseTool* Viewport::activeTool() const {
  if (guest_ && view_ == guest_.get()) return guestTool_;
  return view_ == &motion_ ? tool_ : nullptr;
}

void Viewport::refreshTools() {
  toolHolds_ = false;
  // It is not turned off: whoever looks at what is under the pointer has asked for it as well.
  if (tool_ || activeTool()) setMouseTracking(true);
  if (!activeTool()) unsetCursor();
  redraw();
}

bool Viewport::pressTool(const QPointF& place, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  const double ratio = devicePixelRatioF();
  toolHolds_ = activeTool() && activeTool()->press(place.x() * ratio, place.y() * ratio, button, modifiers);
  if (toolHolds_) setCursor(Qt::ClosedHandCursor);
  return toolHolds_;
}

void Viewport::dragTool(const QPointF& place) {
  const double ratio = devicePixelRatioF();
  if (MouseTool* tool = activeTool()) tool->drag(place.x() * ratio, place.y() * ratio);
}

void Viewport::releaseTool() {
  toolHolds_ = false;
  setCursor(Qt::OpenHandCursor);
  if (MouseTool* tool = activeTool()) tool->release();
}

void Viewport::hoverTool(const QPointF& place) {
  const double ratio = devicePixelRatioF();
  if (activeTool()->hover(place.x() * ratio, place.y() * ratio))
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
