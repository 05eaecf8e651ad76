#include "ui/panels/boundary_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/render/patch_configuration.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::panels {

using document::StudyStatus;

namespace {

QString percent(double strain, int digits = 4) {
  const QString number = QString::number(std::abs(100 * strain), 'g', digits);
  return (strain < 0 ? QStringLiteral("−") : QString()) + number + QStringLiteral(" %");
}

bool isUnderWay(const document::StudyState& study) {
  return study.status == StudyStatus::running || study.status == StudyStatus::waiting;
}

}  // namespace

QString strainText(const Eigen::Vector3d& greenStrain) {
  const scene::PrincipalStretch stretch = scene::principalStretch(greenStrain);
  return QObject::tr("E_x %1,  E_y %2,  E_xy %3;  λ₁ %4 at %5°,  λ₂ %6")
      .arg(percent(greenStrain[0]), percent(greenStrain[1]), percent(greenStrain[2]))
      .arg(stretch.larger, 0, 'f', 4)
      .arg(stretch.angle * 180 / std::numbers::pi, 0, 'f', 0)
      .arg(stretch.smaller, 0, 'f', 4);
}

bool BoundaryPanel::shows(const std::string& type) { return type == "stretch_boundary" || type == "bending_boundary"; }

BoundaryPanel::BoundaryPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent)
    : QWidget(parent), document_(document), quick_(quick), view_(std::make_shared<render::BoundaryView>()) {
  makeWidgets();
  refreshSliceAxes();
  connectParts();
  fillStudies();
  refresh();
}

std::string BoundaryPanel::study() const { return studies_->currentText().toStdString(); }

QString BoundaryPanel::readout() const { return readout_->text(); }

std::shared_ptr<const scene::LimitSurface> BoundaryPanel::resultOf(const std::string& name) const {
  const document::StudyState* state = document_.study(name);
  return state ? std::dynamic_pointer_cast<const scene::LimitSurface>(state->result) : nullptr;
}

const scene::BoundarySpace& BoundaryPanel::space() const {
  const document::StudyState* state = document_.study(study());
  return state && state->type == "bending_boundary" ? scene::curvatureSpace() : scene::strainSpace();
}

double BoundaryPanel::factor() const { return space().factor; }

QString BoundaryPanel::distanceText(double value, int digits) const {
  return (value < 0 ? QStringLiteral("−") : QString()) + QString::number(std::abs(factor() * value), 'g', digits) +
         ' ' + QString::fromStdString(space().unit);
}

QString BoundaryPanel::placeText(const Eigen::Vector3d& place) const {
  return space().unit == "%" ? strainText(place) : QString::fromStdString(render::curvatureText(place));
}

void BoundaryPanel::setStudy(const std::string& name) {
  const int index = studies_->findText(QString::fromStdString(name));
  if (index < 0) return;
  studies_->setCurrentIndex(index);
  refresh();
}

void BoundaryPanel::fillStudies() {
  const QString before = studies_->currentText();
  studies_->clear();
  for (const document::StudyState& study : document_.studies())
    if (shows(study.type)) studies_->addItem(QString::fromStdString(study.name));
  studies_->setCurrentIndex(std::max(0, studies_->findText(before)));
  fillComparisons();
}

bool BoundaryPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == viewport_ && event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_F || (key >= Qt::Key_0 && key <= Qt::Key_6)) {
      event->accept();
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

void BoundaryPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void BoundaryPanel::refresh() {
  const document::StudyState* state = document_.study(study());
  const auto result = resultOf(study());
  run_->setVisible(state != nullptr);
  run_->setEnabled(state && !isUnderWay(*state));
  run_->setText(tr("Run %1").arg(studies_->currentText()));
  note_->setText(
      !state ? tr("Studies of the types stretch_boundary and bending_boundary find all deformations that an "
                  "interlocking material can reach. This scene has none; add one in the scene's tree.")
      : isUnderWay(*state)
          ? tr("The first limits are on their way.")
          : tr("The study “%1” finds all deformations that this material can reach.").arg(studies_->currentText()));
  const bool another = result != result_;
  if (another) {
    const bool otherRays =
        !result || !result_ || result->boundary.mesh.directions.size() != result_->boundary.mesh.directions.size();
    result_ = result;
    surface_ = result ? std::make_shared<scene::BoundarySurface>(scene::boundarySurface(*result, study())) : nullptr;
    if (surface_ && surface_->triangles.empty()) surface_ = nullptr;
    if (otherRays && view_->selected()) examine(-1);
    view_->setSurface(surface_);
    refreshQuantities();
    refreshSlice();
    Q_EMIT resultShown();
  }
  if (state && state->name != shownStudy_) {
    shownStudy_ = state->name;
    if (view_->selected()) examine(-1);
    refreshSliceAxes();
    fillComparisons();
    refreshCompared();
  }
  pages_->setCurrentIndex(surface_ ? 1 : 0);
  if (!state || !surface_) return;
  view_->setStale(state->stale);
  view_->setCaption(caption(*state).toStdString());
  viewport_->redrawGuest(another);
  if (readout_->text().isEmpty() || !view_->selected())
    readout_->setText(tr("Point at a limit to read it; click it to see the elements lock."));
}

QString BoundaryPanel::caption(const document::StudyState& study) const {
  const int known = surface_->knownCount(), all = static_cast<int>(result_->boundary.states.size());
  QString text = QString::fromStdString(study.name);
  if (isUnderWay(study)) return text + '\n' + tr("running: %1 of %2 limits").arg(known).arg(all);
  if (study.status == StudyStatus::cancelled)
    return text + '\n' + tr("cancelled: %1 of %2 limits; Run goes on from here").arg(known).arg(all);
  if (known < all) return text + '\n' + tr("%1 of %2 limits are known: %3").arg(known).arg(all).arg(study.message);
  text += tr(",  %1 limits\nsurface within %2 of the mean distance")
              .arg(all)
              .arg(percent(result_->boundary.largestError, 2));
  if (const int beyond = result_->boundary.count(&interlock::BoundaryState::seesBeyond); beyond > 0)
    text += '\n' + tr("not star-shaped in %1 directions").arg(beyond);
  if (predicted_) text += '\n' + tr("transparent: predicted for the element now set; Update solves it");
  return text;
}

void BoundaryPanel::refreshQuantities() {
  const QSignalBlocker block(quantities_);
  const QString before = quantities_->currentData().toString();
  quantities_->clear();
  if (surface_)
    for (const scene::BoundaryQuantity& quantity : surface_->quantities) {
      QString label = QString::fromStdString(quantity.label);
      quantities_->addItem(label.replace('\n', ' '), QString::fromStdString(quantity.key));
    }
  quantities_->addItem(tr("plain"), QString());
  const int index = before.isNull() ? 0 : quantities_->findData(before);
  quantities_->setCurrentIndex(std::max(0, index));
  applyStyle();
}

/// Names, unit and steps of the space; a slice stays where the axes stay.
void BoundaryPanel::refreshSliceAxes() {
  const QString unit = QStringLiteral(" ") + QString::fromStdString(space().unit);
  if (sliceValue_->suffix() == unit) return;
  const QSignalBlocker block(sliceValue_);
  sliceValue_->setSuffix(unit);
  sliceValue_->setSingleStep(unit == QLatin1String(" %") ? 0.5 : 2);
  sliceValue_->setValue(0);
  sliceAxes_->clear();
  sliceAxes_->addItem(tr("none"));
  for (const std::string& axis : space().axes) sliceAxes_->addItem(tr("%1 = const").arg(QString::fromStdString(axis)));
  refreshSlice();
  applyStyle();
}

void BoundaryPanel::refreshSlice() {
  const int axis = sliceAxes_->currentIndex() - 1;
  for (QWidget* widget : std::initializer_list<QWidget*>{slice_, sliceValue_}) widget->setEnabled(axis >= 0);
  if (axis < 0) return;
  const auto [low, high] = view_->range(axis);
  const QSignalBlocker block(slice_);
  if (high > low)
    slice_->setValue(
        static_cast<int>(std::lround(sliceSteps * (sliceValue_->value() / factor() - low) / (high - low))));
}

void BoundaryPanel::applyStyle() {
  render::BoundaryStyle style;
  style.quantity = quantities_->currentData().toString().toStdString();
  style.opacity = 0.01 * opacity_->value();
  style.shadows = shadows_->isChecked();
  style.states = states_->isChecked();
  if (sliceAxes_->currentIndex() > 0) style.sliceAxis = sliceAxes_->currentIndex() - 1;
  style.slicePosition = sliceValue_->value() / factor();
  view_->setStyle(style);
  viewport_->redrawGuest();
}

void BoundaryPanel::hover(std::optional<QPointF> place) {
  const std::optional<int> state = place ? viewport_->nodeAt(*place) : std::nullopt;
  if (state == hovered_) return;
  hovered_ = state;
  view_->setHovered(state);
  viewport_->redrawGuest();
  const std::optional<int> told = state ? state : view_->selected();
  readout_->setText(told ? describe(*told) : tr("Point at a limit to read it; click it to see the elements lock."));
}

void BoundaryPanel::examine(int state) {
  const bool none = state < 0 || !surface_ || state >= surface_->points.cols();
  view_->setSelected(none ? std::nullopt : std::optional(state));
  viewport_->redrawGuest();
  readout_->setText(none ? QString() : describe(state));
  Q_EMIT stateExamined(none ? -1 : state);
}

QString BoundaryPanel::describe(int state) const {
  if (!surface_ || state >= surface_->points.cols()) return {};
  QString text = placeText(surface_->points.col(state)) + '\n';
  const interlock::BoundaryState& limit = result_->boundary.states[static_cast<std::size_t>(state)];
  text += tr("Limit %1:  distance %2,  could gain %3,  %4 touching pairs,  gap %5 r")
              .arg(state)
              .arg(distanceText(limit.distance), distanceText(limit.remaining, 2))
              .arg(limit.contacts)
              .arg(limit.meanGap / result_->body()->smallestRadius(), 0, 'g', 2);
  if (limit.seesBeyond)
    text += tr(";  not star-shaped here");
  else if (limit.raised)
    text += tr(";  raised by a neighbour");
  return text;
}

}  // namespace pliant::panels
