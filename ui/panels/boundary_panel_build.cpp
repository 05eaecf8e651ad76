#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <cmath>

#include "ui/panels/boundary_panel.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::panels {

namespace {
constexpr int controlWidth = 216, controlHeight = 26;
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
  viewport_->setAccessibleName(tr("Boundary of stretch or bending"));
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
  slice_ = new QSlider(Qt::Horizontal);
  slice_->setRange(0, sliceSteps);
  slice_->setToolTip(tr("Where it is cut"));
  slice_->setAccessibleName(tr("Place of the slice"));
  sliceValue_ = new QDoubleSpinBox;
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
    sliceValue_->setValue(factor() * std::lerp(low, high, static_cast<double>(place) / sliceSteps));
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

}  // namespace pliant::panels
