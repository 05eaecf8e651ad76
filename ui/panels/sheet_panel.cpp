#include "ui/panels/sheet_panel.hpp"

#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSplitter>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "ui/panels/boundary_panel.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_export.hpp"
#include "ui/render/patch_configuration.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::panels {

namespace {

using scene::SheetLimit;

constexpr double setOpacity = 0.35;
constexpr int frameDelay = 100;  ///< of plots behind a motion that plays [ms]

}  // namespace

SheetPanel::SheetPanel(document::Document& document, QWidget* parent)
    : StudyPanel(document, {"macro_equilibrium", "macro_motion"}, parent),
      space_(std::make_shared<render::BoundaryView>()) {
  makeControls();
  plot_ = new plots::LinePlot;
  auto* split = new QSplitter(Qt::Horizontal);
  split->setChildrenCollapsible(false);
  split->addWidget(plot_);
  split->addWidget(makeSpace());
  split->setStretchFactor(0, 1);
  split->setStretchFactor(1, 1);
  setPlot(split);
  frameTimer_.setSingleShot(true);
  frameTimer_.setInterval(frameDelay);
  connect(&frameTimer_, &QTimer::timeout, this, [this] {
    if (!result_ || !isVisible()) return;
    moment_ = scene::sheetMoment(*result_, frame_);
    if (plots_->currentIndex() == nearnessPlot) refreshPlot();
    refreshSpace();
  });
  connect(plot_, &plots::LinePlot::placeChosen, this, [this](double x) {
    if (plots_->currentIndex() == motionPlot) Q_EMIT instantChosen(x / instantScale());
  });
  setMinimumWidth(320);  // of its own, so that the docks beside it keep their width
}

void SheetPanel::makeControls() {
  const auto combo = [this](const QString& tooltip, const QStringList& items) {
    auto* made = new QComboBox;
    made->addItems(items);
    made->setToolTip(tooltip);
    made->setFixedHeight(28);
    switches()->addWidget(made);
    return made;
  };
  fields_ = combo(tr("What colours the sheet; or its elements, where the study has placed them"),
                  {tr("Nearest limit"), tr("Stretch"), tr("Bending"), tr("Elements")});
  connect(fields_, &QComboBox::activated, this, &SheetPanel::viewChanged);
  plots_ = combo(tr("What the plot shows"), {tr("Nearness to limits"), tr("Deflection of all sheets")});
  connect(plots_, &QComboBox::activated, this, &SheetPanel::refreshPlot);
  native_ = new QToolButton;
  native_->setText(tr("Native"));
  native_->setToolTip(tr("The elements that were computed under the same loads, beside the sheet"));
  native_->setCheckable(true);
  native_->setChecked(true);
  native_->setFixedHeight(28);
  switches()->addWidget(native_);
  connect(native_, &QToolButton::toggled, this, &SheetPanel::viewChanged);
  auto* outlines = addButton(tr("Outline"), tr("Cut the piece as a disk, a square or a hexagon, or as a file says"));
  auto* outlineMenu = new QMenu(outlines);
  outlineMenu->addAction(tr("Disk"), this, [this] { setOutline(SheetOutline::disk); });
  outlineMenu->addAction(tr("Square"), this, [this] { setOutline(SheetOutline::square); });
  outlineMenu->addAction(tr("Hexagon"), this, [this] { setOutline(SheetOutline::hexagon); });
  outlineMenu->addAction(tr("From a file…"), this, &SheetPanel::chooseOutlineFile);
  outlines->setMenu(outlineMenu);
  outlines->setPopupMode(QToolButton::InstantPopup);
  auto* families = addButton(tr("Series"), tr("Run this sheet finer, or with a stiffer base, to compare"));
  auto* menu = new QMenu(families);
  menu->addAction(tr("4 and 16 times as many triangles (Fig. 4.10)"), this, [this] { addFamily(Family::refinement); });
  menu->addAction(tr("4 and 16 times Young's modulus (Fig. 4.11)"), this, [this] { addFamily(Family::youngModulus); });
  menu->addAction(tr("Loads in 10 steps, to be watched"), this, &SheetPanel::addLoadSteps);
  families->setMenu(menu);
  families->setPopupMode(QToolButton::InstantPopup);
}

QWidget* SheetPanel::makeSpace() {
  auto* widget = new QWidget;
  spaces_ = new QComboBox;
  spaces_->addItems({tr("Stretch"), tr("Bending")});
  spaces_->setToolTip(tr("Which strains of all triangles are shown, within their limits"));
  spaces_->setFixedHeight(28);
  connect(spaces_, &QComboBox::activated, this, &SheetPanel::refreshSpace);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(0, 0, 8, 4);
  row->setSpacing(4);
  row->addWidget(spaces_);
  row->addStretch();
  clicks_ = new QButtonGroup(this);
  const auto click = [this, row](Clicks clicks, const QString& text, const QString& tooltip) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setToolTip(tooltip);
    made->setCheckable(true);
    made->setFixedHeight(28);
    clicks_->addButton(made, static_cast<int>(clicks));
    row->addWidget(made);
  };
  click(Clicks::read, tr("Read"), tr("A click at the sheet reads a triangle out"));
  click(Clicks::clamp, tr("Clamp"), tr("A click at the sheet clamps a node, or frees it again"));
  click(Clicks::load, tr("Load"), tr("A click at the sheet puts this force on a node, or takes it away again"));
  click(Clicks::paint, tr("Paint"),
        tr("A drag over the sheet gives its triangles the material beside; with Ctrl it wipes that off"));
  clicks_->button(0)->setChecked(true);
  connect(clicks_, &QButtonGroup::idToggled, this, [this] { Q_EMIT viewChanged(); });
  force_ = new QDoubleSpinBox;
  force_->setRange(-1000, 1000);
  force_->setDecimals(3);
  force_->setSingleStep(0.1);
  force_->setValue(-0.5);
  force_->setSuffix(tr(" N up"));
  force_->setToolTip(tr("The force of a load that a click adds; below 0 it pulls down"));
  force_->setFixedHeight(28);
  row->addWidget(force_);
  paints_ = new QComboBox;
  paints_->setToolTip(tr("The material that is painted"));
  paints_->setFixedHeight(28);
  row->addWidget(paints_);
  const auto fit = [this] {
    force_->setVisible(clicks() != Clicks::paint);
    paints_->setVisible(clicks() == Clicks::paint);
  };
  connect(clicks_, &QButtonGroup::idToggled, this, fit);
  fit();
  spaceViewport_ = new viewport::Viewport;
  spaceViewport_->setAccessibleName(tr("Strains of the triangles within their limits"));
  render::BoundaryStyle style;
  style.quantity = "";
  style.opacity = setOpacity;
  space_->setStyle(style);
  spaceViewport_->setGuest(space_);
  spaceViewport_->setAxisView(render::AxisView::isometric);
  readout_ = new QLabel;
  readout_->setWordWrap(true);
  readout_->setContentsMargins(8, 2, 8, 4);
  readout_->setFixedHeight(2 * readout_->fontMetrics().height() + 8);
  readout_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* column = new QVBoxLayout(widget);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(row);
  column->addWidget(spaceViewport_, 1);
  column->addWidget(readout_);
  return widget;
}

QString SheetPanel::readout() const { return readout_->text(); }

render::MacroField SheetPanel::field() const {
  const int chosen = fields_->currentIndex();
  return chosen == 1   ? render::MacroField::stretch
         : chosen == 2 ? render::MacroField::bending
                       : render::MacroField::nearest;
}

bool SheetPanel::showsNative() const { return native_->isChecked(); }

bool SheetPanel::showsElements() const { return fields_->currentIndex() == 3; }

SheetPanel::Clicks SheetPanel::clicks() const { return static_cast<Clicks>(clicks_->checkedId()); }

void SheetPanel::setClicks(Clicks clicks) { clicks_->button(static_cast<int>(clicks))->setChecked(true); }

QString SheetPanel::absentNote() const {
  return tr(
      "Studies of the types macro_equilibrium and macro_motion hang, press or move a large piece of an interlocking "
      "material. "
      "This scene has none; add one in the scene's tree.");
}

QString SheetPanel::waitingNote(const QString& study) const {
  return tr("The study “%1” finds where a large piece of this material rests under its loads.").arg(study);
}

bool SheetPanel::present(const document::StudyState* study) {
  if (study) fillPaints();
  const auto result = std::dynamic_pointer_cast<const scene::MacroResult>(study ? study->result : nullptr);
  if (result != result_) {
    if (!result || (triangle_ && *triangle_ >= static_cast<int>(result->sheet->mesh.triangles.size())))
      triangle_.reset();
    if (!result || !result_ || result->sheet != result_->sheet) frame_ = -1;
    result_ = result;
    if (result_) moment_ = scene::sheetMoment(*result_, frame_);
    native_->setVisible(result_ && result_->native && result_->native->patch);
    const bool moves = result_ && !result_->frames.empty(), offered = plots_->count() > motionPlot;
    if (!moves && offered) plots_->removeItem(motionPlot);
    if (moves && !offered) plots_->addItem({});
    if (moves)
      plots_->setItemText(motionPlot, result_->isMotion() ? tr("Nearness over time") : tr("Nearness over loads"));
    refreshSpace();
  }
  refreshPlot();
  space_->setStale(study && study->stale);
  spaceViewport_->redrawGuest();
  return result_ && result_->state.positions.size() > 0;
}

void SheetPanel::setFrame(int frame, double seconds) {
  instant_ = seconds;
  if (plots_->currentIndex() == motionPlot) plot_->setInstant(seconds * instantScale());
  if (frame == frame_) return;
  frame_ = frame;
  if (!frameTimer_.isActive()) frameTimer_.start();
}

void SheetPanel::refreshSpace() {
  const SheetLimit limit = spaces_->currentIndex() == 1 ? SheetLimit::bending : SheetLimit::stretch;
  const int shown = triangle_.value_or(0);
  surface_ = result_ ? scene::materialBoundary(*result_, limit, shown) : nullptr;
  space_->setSurface(surface_);
  std::optional<int> ringed;
  Eigen::Matrix3Xd places(3, 0);
  if (surface_ && moment_.strains.stretch.cols() > 0) {
    const std::vector<int> triangles = scene::trianglesLike(*result_, shown);
    places = scene::strainPlaces(moment_, limit, triangles);
    if (triangle_)
      ringed = static_cast<int>(std::find(triangles.begin(), triangles.end(), *triangle_) - triangles.begin());
  }
  space_->setInside(places, ringed);
  space_->setCaption(result_ && !surface_ ? tr("Without limits of this kind").toStdString() : "");
  spaceViewport_->redrawGuest(true);
  if (!triangle_ || !ringed) {
    readout_->setText(tr("Click at the sheet to read a triangle: each dot is one of them."));
  } else {
    const auto index = static_cast<Eigen::Index>(*triangle_);
    const Eigen::Vector3d place = places.col(*ringed);
    const double gauge = limit == SheetLimit::stretch ? moment_.stretchGauge[index] : moment_.bendingGauge[index];
    readout_->setText(tr("Triangle %1:  %2 % of the way to its limit\n%3")
                          .arg(*triangle_)
                          .arg(100 * gauge, 0, 'f', 1)
                          .arg(limit == SheetLimit::stretch ? strainText(place)
                                                            : QString::fromStdString(render::curvatureText(place))));
  }
  Q_EMIT viewChanged();
}

void SheetPanel::exportTo(const QString& file) {
  plots::exportPlot(*plot_->plot(), file, [this] { return plot_->toCsv(); });
}

}  // namespace pliant::panels
