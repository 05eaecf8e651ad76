#include "ui/plots/polar_editor.hpp"

#include <QEvent>
#include <QPainter>

#include "ui/plots/plot_export.hpp"
#include "ui/plots/polar_drawing.hpp"

namespace pliant::plots {

PolarEditor::PolarEditor(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(tr("Polar plot of the stretch limit"));
  setToolTip(
      tr("Drag a handle to change how far the cloth may stretch in its direction.\n"
         "Double click on the curve adds a point, Delete removes the selected one;\n"
         "arrow keys nudge it, with Shift ten times finer."));
  picture_.emptyText = tr("No stretch limit yet.");
}

void PolarEditor::setLimit(const std::optional<cloth::StretchLimit>& limit, bool another) {
  if (isDragging() && !another) return;
  dragged_ = -1;
  if (!limit) {
    picture_.shape.reset();
    picture_.constraints.reset();
    picture_.reached.resize(0);
  } else if (!picture_.shape || another) {
    picture_.shape.emplace(*limit);
    picture_.constraints.reset();
  } else if (!sameLimit(picture_.shape->limit(), *limit)) {
    picture_.shape->setLimit(*limit);
    nudged_ = -1;
  }
  if (!picture_.shape || another || picture_.selected >= picture_.shape->handleCount()) select(-1);
  refit(another);
}

void PolarEditor::setEmptyText(const QString& text) {
  picture_.emptyText = text;
  update();
}

void PolarEditor::setConstraints(std::optional<cloth::LimitConstraints> constraints) {
  picture_.constraints = std::move(constraints);
  refit(false);
}

void PolarEditor::setMeasured(std::vector<MeasuredLimit> measured) {
  picture_.measured = std::move(measured);
  refit(false);
}

void PolarEditor::setReached(Eigen::VectorXd reached, const QString& name) {
  picture_.reached = std::move(reached);
  picture_.reachedName = name;
  refit(false);
}

void PolarEditor::setPercent(bool percent) {
  picture_.percent = percent;
  update();
}

void PolarEditor::layOut() {
  layOutPolar(axis_, rect(), picture_, font());
  if (!isDragging()) placeRingLabels(axis_, picture_);
}

void PolarEditor::refit(bool anyway) {
  if (!isDragging()) {
    if (anyway)
      axis_.fit(largestStretch(picture_));
    else
      axis_.refit(largestStretch(picture_));
  }
  layOut();
  update();
}

void PolarEditor::finish(const std::string& refusal, const QString& text, int mergeId) {
  if (refusal.empty())
    Q_EMIT edited(text, mergeId);
  else
    Q_EMIT refused(QString::fromStdString(refusal));
  refit(false);
}

void PolarEditor::setKind(LimitKind kind) {
  if (!shape() || shape()->kind() == kind) return;
  select(-1);
  picture_.shape->setKind(kind);
  finish({}, tr("Kind of stretch limit"));
}

void PolarEditor::setSymmetry(LimitSymmetry symmetry) {
  if (!shape() || shape()->symmetry() == symmetry) return;
  select(-1);
  const cloth::StretchLimit before = shape()->limit();
  picture_.shape->setSymmetry(symmetry);
  if (!sameLimit(before, shape()->limit())) finish({}, tr("Mirror the stretch limit"));
  update();
}

void PolarEditor::takePreset(const LimitPreset& preset) {
  select(-1);
  if (picture_.shape)
    picture_.shape->setLimit(preset.limit, true);
  else
    picture_.shape.emplace(preset.limit);
  axis_.fit(largestStretch(picture_));
  finish({}, tr("Stretch limit “%1”").arg(QLatin1String(preset.name)));
}

void PolarEditor::putHandle(int handle, const cloth::DirectionLimit& place) {
  if (!shape() || handle < 0 || handle >= shape()->handleCount()) return;
  const std::string refusal = picture_.shape->put(handle, place);
  if (refusal.empty() && shape()->kind() == LimitKind::free) select(shape()->nearestHandle(place.angle));
  finish(refusal, tr("Stretch limit at %1").arg(placeText(place.angle, place.stretch, picture_.percent)));
}

void PolarEditor::addPoint(double angle) {
  if (!shape()) return;
  const std::string refusal = picture_.shape->add(angle);
  if (refusal.empty()) select(shape()->nearestHandle(angle));
  finish(refusal, tr("Add a point to the stretch limit"));
}

void PolarEditor::removePoint(int handle) {
  if (!shape() || handle < 0 || handle >= shape()->handleCount()) return;
  const std::string refusal = picture_.shape->remove(handle);
  if (refusal.empty()) select(-1);
  finish(refusal, tr("Delete a point of the stretch limit"));
}

void PolarEditor::select(int handle) {
  nudged_ = -1;
  if (picture_.selected == handle) return;
  picture_.selected = handle;
  picture_.numbered = -1;
  update();
  Q_EMIT selectionChanged(handle);
}

void PolarEditor::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  if (isDragging() || picture_.numbered < 0) return;
  picture_.numbered = -1;
  update();
}

void PolarEditor::changeEvent(QEvent* event) {
  if (event->type() == QEvent::FontChange) layOut();
  QWidget::changeEvent(event);
  update();
}

void PolarEditor::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layOut();
}

void PolarEditor::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paintPolar(painter, rect(), axis_, picture_, palette(), font());
}

void PolarEditor::exportTo(const QString& file) {
  PolarPicture plain = picture_;
  plain.selected = plain.numbered = -1;
  plain.handles = false;
  exportPainting(
      size(), file, [&](QPainter& painter) { paintPolar(painter, rect(), axis_, plain, palette(), font()); },
      [&] { return polarCsv(plain); });
}

}  // namespace pliant::plots
