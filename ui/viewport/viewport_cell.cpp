#include <QMouseEvent>
#include <algorithm>

#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {

namespace {

constexpr double gripRadius = 9;  // device-independent pixels

bool isSameKind(const interlock::UnitCell& a, const interlock::UnitCell& b) {
  return a.elements.size() == b.elements.size() &&
         std::equal(a.shapes.begin(), a.shapes.end(), b.shapes.begin(), b.shapes.end(),
                    [](const auto& x, const auto& y) { return x.pieces.size() == y.pieces.size(); });
}

}  // namespace

void Viewport::setCell(std::shared_ptr<const interlock::UnitCell> cell) {
  if (cell == cell_.cell()) return;
  // The same material with other numbers is seen from where it was, so that one sees what changes.
  const bool alike = cell && cell_.cell() && isSameKind(*cell_.cell(), *cell);
  const bool shown = cell != nullptr;
  cell_.setCell(std::move(cell));
  if (shown) {
    pause();
    showView(cell_);
  } else {
    endGrip();
    unsetCursor();
    if (showsCell()) showView(motion_);
  }
  setMouseTracking(shown || live_);
  if (shown && !alike) {
    framed_ = true;
    cell_.setAxisView(render::AxisView::top);
    cell_.orbit(-0.06, -0.2);
    cell_.fit();
  }
  redraw();
}

void Viewport::showCellState(const interlock::CellState& state, const std::vector<interlock::LiveContact>& contacts) {
  if (!showsCell()) return;
  cell_.setState(state, contacts);
  if (framed_ && !grip_) cell_.fit();
  redraw(true);
}

std::optional<render::CellPick> Viewport::gripAt(const QPointF& place) const {
  const double ratio = devicePixelRatioF();
  return cell_.pick(place.x() * ratio, place.y() * ratio, gripRadius * ratio);
}

void Viewport::beginGrip(const QMouseEvent& event) {
  if (event.modifiers() & Qt::ShiftModifier) return;
  grip_ = gripAt(event.position());
  if (!grip_) return;
  framed_ = false;  // a view that follows what is pulled would run away from the mouse
  const double ratio = devicePixelRatioF();
  const auto begin = cell_.handAt(*grip_, event.position().x() * ratio, event.position().y() * ratio);
  gripOffset_ = begin ? Eigen::Vector3d(grip_->place - *begin) : Eigen::Vector3d::Zero();
  setCursor(Qt::ClosedHandCursor);
  Q_EMIT gripPulled(*grip_, grip_->place);
}

void Viewport::moveGrip(const QPointF& place) {
  const double ratio = devicePixelRatioF();
  if (const auto hand = cell_.handAt(*grip_, place.x() * ratio, place.y() * ratio))
    Q_EMIT gripPulled(*grip_, *hand + gripOffset_);
}

void Viewport::endGrip() {
  if (!grip_) return;
  grip_.reset();
  setCursor(Qt::OpenHandCursor);
  Q_EMIT gripLetGo();
}

}  // namespace pliant::viewport
