#include "ui/panels/boundary_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/viewport/viewport.hpp"

namespace pliant::panels {

using document::StudyStatus;

namespace {

const std::string boundaryType = "stretch_boundary";
constexpr int controlWidth = 216, controlHeight = 26, sliceSteps = 400;

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

BoundaryPanel::BoundaryPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent)
    : QWidget(parent), document_(document), quick_(quick), view_(std::make_shared<render::BoundaryView>()) {
  makeWidgets();
  connectParts();
  fillStudies();
  refresh();
}

void BoundaryPanel::makeWidgets() {
  auto* empty = new QWidget;
  auto* middle = new QVBoxLayout(empty);
  note_ = new QLabel;
  note_->setWordWrap(true);
  note_->setAlignment(Qt::AlignCenter);
  run_ = new QPushButton;
  middle->addStretch();
  middle->addWidget(note_);
  middle->addWidget(run_, 0, Qt::AlignHCenter);
  middle->addStretch();

  viewport_ = new viewport::Viewport;
  viewport_->setAccessibleName(tr("Strain-space boundary"));
  viewport_->setMouseTracking(true);
  viewport_->installEventFilter(this);
  viewport_->setGuest(view_);
  viewport_->setAxisView(render::AxisView::isometric);
  readout_ = new QLabel;
  readout_->setContentsMargins(12, 2, 12, 4);
  readout_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  readout_->setWordWrap(true);
  // Its room is kept, so that the surface does not move under the pointer.
  readout_->setFixedHeight(2 * readout_->fontMetrics().height() + 8);
  readout_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* shown = new QWidget;
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  row->addWidget(viewport_, 1);
  row->addWidget(makeControls());
  auto* column = new QVBoxLayout(shown);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(row, 1);
  column->addWidget(readout_);
  pages_ = new QStackedLayout(this);
  pages_->addWidget(empty);
  pages_->addWidget(shown);
}

QWidget* BoundaryPanel::makeControls() {
  auto* controls = new QWidget;
  // Scrolled where the dock is low, which they would otherwise keep high for all scenes.
  auto* area = new QScrollArea;
  area->setFrameShape(QFrame::NoFrame);
  area->setWidgetResizable(true);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setFixedWidth(controlWidth);
  auto* form = new QFormLayout(controls);
  form->setContentsMargins(8, 8, 12, 8);
  form->setHorizontalSpacing(8);
  form->setVerticalSpacing(4);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const auto combo = [&](const QString& label, const QString& tooltip) {
    auto* made = new QComboBox;
    made->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    made->setFixedHeight(controlHeight);
    made->setToolTip(tooltip);
    made->setAccessibleName(label);
    form->addRow(label, made);
    return made;
  };
  studies_ = combo(tr("Study"), tr("Whose boundary is shown"));
  quantities_ = combo(tr("Colour"), tr("What colours the surface"));
  comparisons_ = combo(tr("Compare"), tr("Another boundary, drawn over this one"));
  opacity_ = new QSlider(Qt::Horizontal);
  opacity_->setRange(15, 100);
  opacity_->setValue(100);
  opacity_->setToolTip(tr("How opaque the surface is"));
  form->addRow(tr("Opacity"), opacity_);
  sliceAxes_ = combo(tr("Slice"), tr("Cut by a plane across an axis"));
  sliceAxes_->addItems({tr("none"), tr("E_x = const"), tr("E_y = const"), tr("E_xy = const")});
  slice_ = new QSlider(Qt::Horizontal);
  slice_->setRange(0, sliceSteps);
  slice_->setToolTip(tr("Where it is cut"));
  slice_->setAccessibleName(tr("Place of the slice"));
  sliceValue_ = new QDoubleSpinBox;
  sliceValue_->setSuffix(QStringLiteral(" %"));
  sliceValue_->setDecimals(2);
  sliceValue_->setRange(-10000, 10000);
  sliceValue_->setKeyboardTracking(false);
  sliceValue_->setFixedHeight(controlHeight);
  sliceValue_->setAccessibleName(tr("Place of the slice"));
  form->addRow(tr("at"), sliceValue_);
  form->addRow(QString(), slice_);
  shadows_ = new QCheckBox(tr("projections"));
  shadows_->setChecked(true);
  shadows_->setToolTip(tr("The surface's shadows on the walls"));
  states_ = new QCheckBox(tr("computed limits"));
  states_->setToolTip(tr("A dot at each limit that was computed; the surface is flat between them"));
  form->addRow(QString(), shadows_);
  form->addRow(QString(), states_);
  auto* exporter = new QPushButton(tr("Export…"));
  exporter->setToolTip(tr("A picture of the surface (PNG), the surface (PLY and others), or its limits (CSV)"));
  connect(exporter, &QPushButton::clicked, this, &BoundaryPanel::exportRequested);
  form->addRow(QString(), exporter);
  area->setWidget(controls);
  return area;
}

void BoundaryPanel::connectParts() {
  connect(run_, &QPushButton::clicked, this, [this] { Q_EMIT runRequested(study()); });
  connect(studies_, &QComboBox::activated, this, [this] { refresh(); });
  connect(quantities_, &QComboBox::activated, this, &BoundaryPanel::applyStyle);
  connect(comparisons_, &QComboBox::activated, this, &BoundaryPanel::chooseComparison);
  connect(opacity_, &QSlider::valueChanged, this, &BoundaryPanel::applyStyle);
  connect(shadows_, &QCheckBox::toggled, this, &BoundaryPanel::applyStyle);
  connect(states_, &QCheckBox::toggled, this, &BoundaryPanel::applyStyle);
  connect(sliceAxes_, &QComboBox::activated, this, [this] {
    const QSignalBlocker block(sliceValue_);
    sliceValue_->setValue(0);
    refreshSlice();
    applyStyle();
  });
  connect(slice_, &QSlider::valueChanged, this, [this](int place) {
    const auto [low, high] = view_->range(sliceAxes_->currentIndex() - 1);
    const QSignalBlocker block(sliceValue_);
    sliceValue_->setValue(100 * std::lerp(low, high, static_cast<double>(place) / sliceSteps));
    applyStyle();
  });
  connect(sliceValue_, &QDoubleSpinBox::valueChanged, this, [this] {
    refreshSlice();
    applyStyle();
  });
  connect(viewport_, &viewport::Viewport::hovered, this, &BoundaryPanel::hover);
  connect(viewport_, &viewport::Viewport::nodePicked, this, &BoundaryPanel::examine);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    files_.clear();
    wanted_.clear();
    examine(-1);
    fillStudies();
    refresh();
  });
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    fillStudies();
    refresh();
  });
  connect(&document_, &document::Document::studyChanged, this, [this](const std::string& name) {
    if (name == study()) refresh();
    fillComparisons();
    if (comparisons_->currentText().toStdString() == name) refreshCompared();
  });
}

std::string BoundaryPanel::study() const { return studies_->currentText().toStdString(); }

QString BoundaryPanel::readout() const { return readout_->text(); }

std::shared_ptr<const scene::StretchBoundaryResult> BoundaryPanel::resultOf(const std::string& name) const {
  const document::StudyState* state = document_.study(name);
  return state ? std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(state->result) : nullptr;
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
    if (study.type == boundaryType) studies_->addItem(QString::fromStdString(study.name));
  studies_->setCurrentIndex(std::max(0, studies_->findText(before)));
  fillComparisons();
}

/// None, the other studies that have a boundary, files that were read, and a file to choose.
void BoundaryPanel::fillComparisons() {
  const QString before = comparisons_->currentText();
  comparisons_->clear();
  comparisons_->addItem(tr("none"));
  for (const document::StudyState& study : document_.studies())
    if (study.type == boundaryType && study.name != this->study() && resultOf(study.name))
      comparisons_->addItem(QString::fromStdString(study.name));
  for (const auto& [name, surface] : files_) comparisons_->addItem(name);
  comparisons_->addItem(tr("from disk…"));
  comparisons_->setCurrentIndex(std::max(0, comparisons_->findText(before)));
}

void BoundaryPanel::chooseComparison(int index) {
  if (index != comparisons_->count() - 1) {
    refreshCompared();
    return;
  }
  const QString file = QFileDialog::getOpenFileName(this, tr("Compare with a boundary"), {}, tr("Boundaries (*.ply)"));
  comparisons_->setCurrentIndex(0);
  refreshCompared();
  if (!file.isEmpty()) compareWithFile(file);
}

void BoundaryPanel::compareWithStudy(const std::string& name) {
  comparisons_->setCurrentIndex(std::max(0, comparisons_->findText(QString::fromStdString(name))));
  refreshCompared();
}

void BoundaryPanel::compareWithFile(const QString& file) {
  wanted_ = file;
  jobs::Job job;
  job.topic = QStringLiteral("boundary file");
  job.title = tr("Read %1").arg(QFileInfo(file).fileName());
  job.work = [panel = QPointer<BoundaryPanel>(this), file](
                 base::ExecutionContext&, const jobs::Publish&) -> jobs::Delivery {
    QString problem;
    std::shared_ptr<const scene::BoundarySurface> surface;
    try {
      surface = std::make_shared<scene::BoundarySurface>(scene::readBoundarySurface(file.toStdString()));
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    return [panel, file, surface, problem] {
      if (BoundaryPanel* self = panel.data()) self->takeFile(file, surface, problem);
    };
  };
  quick_.submit(std::move(job));
}

void BoundaryPanel::takeFile(const QString& file, const std::shared_ptr<const scene::BoundarySurface>& surface,
                             const QString& problem) {
  if (wanted_ != file) return;
  wanted_.clear();
  if (!surface) {
    document_.raise(base::Severity::warning, problem);
    return;
  }
  const QString name = QString::fromStdString(surface->name);
  files_[name] = surface;
  fillComparisons();
  comparisons_->setCurrentIndex(comparisons_->findText(name));
  refreshCompared();
}

void BoundaryPanel::refreshCompared() {
  const QString name = comparisons_->currentText();
  const auto file = files_.find(name);
  const auto other = comparisons_->currentIndex() > 0 ? resultOf(name.toStdString()) : nullptr;
  compared_ = file != files_.end() ? file->second
              : other              ? std::make_shared<scene::BoundarySurface>(scene::boundarySurface(*other))
                                   : nullptr;
  view_->setCompared(compared_);
  viewport_->redrawGuest(true);
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
      !state ? tr("A study of the type stretch_boundary finds all deformations that an interlocking material "
                  "can reach. This scene has none; add one in the scene's tree.")
      : isUnderWay(*state)
          ? tr("The first limits are on their way.")
          : tr("The study “%1” finds all deformations that this material can reach.").arg(studies_->currentText()));
  const bool another = result != result_;
  if (another) {
    const bool otherRays =
        !result || !result_ || result->boundary.mesh.directions.size() != result_->boundary.mesh.directions.size();
    result_ = result;
    surface_ = result ? std::make_shared<scene::BoundarySurface>(scene::boundarySurface(*result)) : nullptr;
    if (surface_ && surface_->triangles.empty()) surface_ = nullptr;
    if (otherRays && view_->selected()) examine(-1);
    view_->setSurface(surface_);
    refreshQuantities();
    refreshSlice();
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

void BoundaryPanel::refreshSlice() {
  const int axis = sliceAxes_->currentIndex() - 1;
  for (QWidget* widget : std::initializer_list<QWidget*>{slice_, sliceValue_}) widget->setEnabled(axis >= 0);
  if (axis < 0) return;
  const auto [low, high] = view_->range(axis);
  const QSignalBlocker block(slice_);
  if (high > low)
    slice_->setValue(static_cast<int>(std::lround(sliceSteps * (0.01 * sliceValue_->value() - low) / (high - low))));
}

void BoundaryPanel::applyStyle() {
  render::BoundaryStyle style;
  style.quantity = quantities_->currentData().toString().toStdString();
  style.opacity = 0.01 * opacity_->value();
  style.shadows = shadows_->isChecked();
  style.states = states_->isChecked();
  if (sliceAxes_->currentIndex() > 0) style.sliceAxis = sliceAxes_->currentIndex() - 1;
  style.slicePosition = 0.01 * sliceValue_->value();
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
  QString text = strainText(surface_->points.col(state)) + '\n';
  const interlock::BoundaryState& limit = result_->boundary.states[static_cast<std::size_t>(state)];
  text += tr("Limit %1:  distance %2,  could gain %3,  %4 touching pairs,  gap %5 r")
              .arg(state)
              .arg(percent(limit.distance), percent(limit.remaining, 2))
              .arg(limit.contacts)
              .arg(limit.meanGap / result_->cell->smallestRadius(), 0, 'g', 2);
  if (limit.seesBeyond)
    text += tr(";  not star-shaped here");
  else if (limit.raised)
    text += tr(";  raised by a neighbour");
  return text;
}

}  // namespace pliant::panels
