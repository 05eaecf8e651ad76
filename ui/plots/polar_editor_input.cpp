#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <cmath>
#include <numbers>

#include "ui/plots/polar_editor.hpp"

namespace pliant::plots {

namespace {

constexpr double seizeRadius = 11;  // pixels
constexpr double degree = std::numbers::pi / 180;
constexpr double dragStretch = 1e-3, dragAngle = degree;  // numbers that are dragged are round; with Shift a tenth
constexpr double nudgeStretch = 5e-3, nudgeAngle = degree;

/// Ids above those of sliders, so that no two edits of different kinds become one.
int nextMergeId() {
  static int last = 1 << 30;
  return ++last;
}

double roundedTo(double value, double step) { return std::round(value / step) * step; }

}  // namespace

int PolarEditor::placeAt(const QPointF& position) const {
  if (!shape()) return -1;
  int nearest = -1;
  double least = seizeRadius;
  const auto places = shape()->places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const QPointF d = handlePoint(axis_, *shape(), places[i]) - position;
    const double distance = std::hypot(d.x(), d.y());
    if (distance >= least) continue;
    least = distance;
    nearest = static_cast<int>(i);
  }
  // The one handle of an isotropic limit is its whole ring.
  return nearest < 0 && shape()->kind() == LimitKind::isotropic && onCurve(position) ? 0 : nearest;
}

bool PolarEditor::onCurve(const QPointF& position) const {
  if (!shape()) return false;
  const double limit = cloth::stretchAt(shape()->limit(), axis_.angleAt(position));
  const QPointF d = position - axis_.centre();
  return std::abs(std::hypot(d.x(), d.y()) - axis_.radiusOf(limit)) < seizeRadius;
}

void PolarEditor::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !shape()) return;
  const int place = placeAt(event->position());
  if (place < 0) {
    select(-1);
    return;
  }
  dragged_ = place;
  grip_ = shape()->places()[static_cast<std::size_t>(place)];
  select(grip_.handle);
  picture_.numbered = place;
  QPointF at = handlePoint(axis_, *shape(), grip_);
  if (shape()->kind() == LimitKind::isotropic) {
    const double limit = shape()->handles()[0].stretch;
    at = axis_.point(axis_.angleAt(event->position()), limit);
  }
  gripOffset_ = event->position() - at;
  before_ = shape();
  moved_ = warned_ = false;
  mergeId_ = nextMergeId();
  update();
}

void PolarEditor::mouseMoveEvent(QMouseEvent* event) {
  if (isDragging()) {
    dragTo(event->position() - gripOffset_, event->modifiers() & Qt::ShiftModifier);
    return;
  }
  const int place = placeAt(event->position());
  setCursor(place >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
  if (picture_.numbered == place) return;
  picture_.numbered = place;
  update();
}

void PolarEditor::dragTo(const QPointF& position, bool fine) {
  const double part = fine ? 0.1 : 1;
  const double angle = roundedTo(grip_.handleAngle(axis_.angleAt(position)), part * dragAngle);
  const double stretch = roundedTo(axis_.stretchAt(position), part * dragStretch);
  const cloth::StretchLimit last = shape()->limit();
  const std::string refusal = picture_.shape->drag(grip_.handle, {angle, stretch});
  if (!refusal.empty() && !warned_) {
    warned_ = true;
    Q_EMIT refused(QString::fromStdString(refusal));
  }
  if (sameLimit(last, shape()->limit())) return;
  moved_ = true;
  update();
  Q_EMIT edited(tr("Stretch limit"), mergeId_);
}

void PolarEditor::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && isDragging()) endDrag(true);
}

void PolarEditor::endDrag(bool keep) {
  dragged_ = -1;
  picture_.numbered = -1;
  if (!keep && before_ && moved_) {
    picture_.shape = before_;
    Q_EMIT edited(tr("Stretch limit"), mergeId_);
  }
  before_.reset();
  if (picture_.shape) {
    const int sorted = picture_.shape->sort(picture_.selected);
    if (sorted != picture_.selected) select(sorted);
  }
  refit(false);
}

void PolarEditor::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !shape()) return;
  const int place = placeAt(event->position());
  if (place >= 0) {
    const int handle = shape()->places()[static_cast<std::size_t>(place)].handle;
    Q_EMIT activated(std::max(0, handle));
  } else if (onCurve(event->position())) {
    addPoint(roundedTo(axis_.angleAt(event->position()), dragAngle));
  }
}

void PolarEditor::contextMenuEvent(QContextMenuEvent* event) {
  if (!shape()) return;
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const int place = placeAt(event->pos());
  const int handle = place < 0 ? -1 : shape()->places()[static_cast<std::size_t>(place)].handle;
  const double angle = roundedTo(axis_.angleAt(event->pos()), dragAngle);
  const bool free = shape()->kind() == LimitKind::free;
  menu->addAction(tr("Add a Point Here"), this, [this, angle] { addPoint(angle); })->setEnabled(free && handle < 0);
  menu->addAction(tr("Delete Point"), this, [this, handle] { removePoint(handle); })->setEnabled(free && handle >= 0);
  menu->addAction(tr("Type Its Numbers…"), this, [this, handle] { Q_EMIT activated(handle); })->setEnabled(handle >= 0);
  menu->addSeparator();
  QAction* percent = menu->addAction(tr("Label Strains in %"), this, [this] { setPercent(!picture_.percent); });
  percent->setCheckable(true);
  percent->setChecked(picture_.percent);
  menu->addAction(tr("Export Plot…"), this, &PolarEditor::exportRequested);
  menu->popup(event->globalPos());
}

void PolarEditor::nudge(int key, bool fine) {
  const int selected = picture_.selected;
  const double part = fine ? 0.1 : 1;
  const bool rotates = selected == LimitShape::rotationHandle;
  cloth::DirectionLimit place = shape()->handles().at(rotates ? 0 : static_cast<std::size_t>(selected));
  const bool upright = key == Qt::Key_Up || key == Qt::Key_Down;
  if (upright)
    place.stretch = roundedTo(place.stretch + (key == Qt::Key_Up ? 1 : -1) * part * nudgeStretch, 1e-6);
  else
    place.angle = roundedTo(place.angle + (key == Qt::Key_Left ? 1 : -1) * part * nudgeAngle, 1e-3 * degree);
  if (nudged_ != selected) mergeId_ = nextMergeId();
  const bool turns = shape()->kind() == LimitKind::orthotropic && !upright;
  const int target = turns ? LimitShape::rotationHandle : selected;
  if (turns && selected == 1) place.angle -= std::numbers::pi / 2;
  finish(picture_.shape->drag(target, place), tr("Stretch limit"), mergeId_);
  nudged_ = selected;
}

void PolarEditor::keyPressEvent(QKeyEvent* event) {
  const bool any = shape().has_value(), chosen = any && picture_.selected != -1;
  const bool fine = event->modifiers() & Qt::ShiftModifier;
  switch (event->key()) {
    case Qt::Key_Escape:
      if (isDragging())
        endDrag(false);
      else if (chosen)
        select(-1);
      else
        break;
      return;
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Left:
    case Qt::Key_Right:
      if (!chosen || isDragging()) break;
      nudge(event->key(), fine);
      return;
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      if (!chosen || isDragging()) break;
      removePoint(picture_.selected);
      return;
    case Qt::Key_PageUp:
    case Qt::Key_PageDown: {
      if (!any || isDragging()) break;
      const int count = shape()->handleCount(), step = event->key() == Qt::Key_PageDown ? 1 : count - 1;
      select(picture_.selected < 0 ? 0 : (picture_.selected + step) % count);
      return;
    }
    default: break;
  }
  QWidget::keyPressEvent(event);
}

}  // namespace pliant::plots
