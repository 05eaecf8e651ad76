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

using scene::Json;
using scene::SheetLimit;

constexpr double setOpacity = 0.35;

/// The largest first, over the share of all triangles that are as near or nearer.
plots::PlotLine sortedLine(const QString& name, Eigen::VectorXd gauges, int group) {
  std::sort(gauges.begin(), gauges.end(), std::greater<>());
  plots::PlotLine line;
  line.name = name;
  line.group = group;
  for (Eigen::Index i = 0; i < gauges.size(); ++i) {
    line.x.push_back(100 * static_cast<double>(i + 1) / static_cast<double>(gauges.size()));
    line.y.push_back(gauges[i]);
  }
  return line;
}

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
  auto* families = addButton(tr("Series"), tr("Run this sheet finer, or with a stiffer base, to compare"));
  auto* menu = new QMenu(families);
  menu->addAction(tr("4 and 16 times as many triangles (Fig. 4.10)"), this, [this] { addFamily(Family::refinement); });
  menu->addAction(tr("4 and 16 times Young's modulus (Fig. 4.11)"), this, [this] { addFamily(Family::youngModulus); });
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
  const auto result = std::dynamic_pointer_cast<const scene::MacroResult>(study ? study->result : nullptr);
  if (result != result_) {
    if (!result || (triangle_ && *triangle_ >= static_cast<int>(result->sheet->mesh.triangles.size())))
      triangle_.reset();
    result_ = result;
    refreshSpace();
  }
  refreshPlot();
  space_->setStale(study && study->stale);
  spaceViewport_->redrawGuest();
  return result_ && result_->state.positions.size() > 0;
}

void SheetPanel::refreshPlot() {
  if (!result_) return;
  plots::LineChart chart;
  if (plots_->currentIndex() == 0) {
    chart.xLabel = tr("share of triangles [%]");
    chart.yLabel = tr("strain / limit");
    chart.legendBelow = true;
    chart.fromZero = true;
    const interlock::MacroState& state = result_->state;
    if (state.stretchGauge.size() > 0) chart.lines.push_back(sortedLine(tr("stretch"), state.stretchGauge, 0));
    if (state.bendingGauge.size() > 0 && state.bendingGauge.maxCoeff() > 0)
      chart.lines.push_back(sortedLine(tr("bending"), state.bendingGauge, 1));
    plot_->setChart(std::move(chart));
    return;
  }
  std::vector<std::array<double, 3>> sheets;  // triangles, Young's modulus, deflection
  for (const document::StudyState& study : document_.studies())
    if (const auto sheet = std::dynamic_pointer_cast<const scene::MacroResult>(study.result);
        sheet && sheet->state.positions.size() > 0)
      sheets.push_back({static_cast<double>(sheet->sheet->mesh.triangles.size()),
                        sheet->sheet->materials.front().youngModulus, scene::largestDeflection(*sheet)});
  const auto varies = [&](std::size_t key) {
    return std::any_of(sheets.begin(), sheets.end(), [&](const auto& sheet) { return sheet[key] != sheets[0][key]; });
  };
  const std::size_t key = varies(0) || !varies(1) ? 0 : 1;
  if (!varies(key)) {
    plot_->setNote(tr("Sheets that differ are compared here: see Series."));
    return;
  }
  std::sort(sheets.begin(), sheets.end(), [key](const auto& a, const auto& b) { return a[key] < b[key]; });
  chart.xLabel = key == 0 ? tr("triangles") : tr("Young's modulus of the base [Pa]");
  chart.yLabel = tr("largest deflection [mm]");
  chart.fromZero = true;
  plots::PlotLine line;
  line.dots = true;
  for (const auto& sheet : sheets) {
    line.x.push_back(sheet[key]);
    line.y.push_back(1e3 * sheet[2]);
  }
  chart.lines.push_back(std::move(line));
  plot_->setChart(std::move(chart));
}

void SheetPanel::refreshSpace() {
  const SheetLimit limit = spaces_->currentIndex() == 1 ? SheetLimit::bending : SheetLimit::stretch;
  const int shown = triangle_.value_or(0);
  surface_ = result_ ? scene::materialBoundary(*result_, limit, shown) : nullptr;
  space_->setSurface(surface_);
  std::optional<int> ringed;
  Eigen::Matrix3Xd places(3, 0);
  if (surface_ && result_->state.strains.stretch.cols() > 0) {
    const std::vector<int> triangles = scene::trianglesLike(*result_, shown);
    places = scene::strainPlaces(*result_, limit, triangles);
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
    const double gauge =
        limit == SheetLimit::stretch ? result_->state.stretchGauge[index] : result_->state.bendingGauge[index];
    readout_->setText(tr("Triangle %1:  %2 % of the way to its limit\n%3")
                          .arg(*triangle_)
                          .arg(100 * gauge, 0, 'f', 1)
                          .arg(limit == SheetLimit::stretch ? strainText(place)
                                                            : QString::fromStdString(render::curvatureText(place))));
  }
  Q_EMIT viewChanged();
}

std::string SheetPanel::pointer(const char* key) const {
  const auto& studies = document_.studies();
  const auto found =
      std::find_if(studies.begin(), studies.end(), [&](const auto& each) { return each.name == study(); });
  return "/studies/" + std::to_string(found - studies.begin()) + "/" + key;
}

void SheetPanel::take(int picked) {
  if (!result_) return;
  if (clicks() == Clicks::read) {
    triangle_ = picked < 0 ? std::nullopt : std::optional(picked);
    refreshSpace();
  } else if (picked >= 0 && clicks() == Clicks::clamp) {
    toggleAt(picked, "clamps", Json::object(), tr("clamps of %1").arg(QString::fromStdString(study())));
  } else if (picked >= 0) {
    toggleAt(
        picked, "loads", {{"force", {0, 0, force_->value()}}}, tr("loads of %1").arg(QString::fromStdString(study())));
  }
}

void SheetPanel::toggleAt(int node, const char* key, const Json& entry, const QString& text) {
  const auto& places = result_->sheet->mesh.points;
  const auto nodeAt = [&](const Json& place) {
    Eigen::Index nearest = 0;
    (places.topRows<2>().colwise() - Eigen::Vector2d(place[0], place[1])).colwise().squaredNorm().minCoeff(&nearest);
    return static_cast<int>(nearest);
  };
  Json entries = Json::array();
  bool taken = false;
  for (const Json& each : document_.valueAt(pointer(key))) {
    if (nodeAt(each["point"]) == node)
      taken = true;
    else
      entries.push_back(each);
  }
  if (!taken) {
    Json added = entry;
    added["point"] = {places(0, node), places(1, node)};
    entries.push_back(added);
  }
  document_.setValue(pointer(key), entries, text);
}

void SheetPanel::addFamily(Family family) {
  const std::string first = study();
  const bool finer = family == Family::refinement;
  Json studies = document_.scene().json()["studies"];
  const auto entry =
      std::find_if(studies.begin(), studies.end(), [&](const Json& each) { return each["name"] == first; });
  if (entry == studies.end()) return;
  const Json pattern = *entry;
  const Json normalized = document_.valueAt(pointer(finer ? "rings" : "young_modulus"));
  if (finer && pattern.value("shape", "disk") == "mesh") {
    document_.raise(base::Severity::warning, tr("A mesh from a file is not made finer here."));
    return;
  }
  std::vector<std::string> names{first};
  bool changed = false;
  for (const int factor : {4, 16}) {
    const std::string name = first + " " + std::to_string(factor) + (finer ? "x triangles" : "x stiffness");
    names.push_back(name);
    if (document_.study(name)) continue;
    Json made = pattern;
    made["name"] = name;
    made["native"] = false;
    if (finer)
      made["rings"] = normalized.get<int>() * (factor == 4 ? 2 : 4);
    else
      made["young_modulus"] = normalized.get<double>() * factor;
    studies.push_back(made);
    changed = true;
  }
  if (changed && !document_.setValue("/studies", studies, tr("a series of %1").arg(QString::fromStdString(first))))
    return;
  plots_->setCurrentIndex(1);
  setStudy(first);
  Q_EMIT studiesRequested(names);
}

void SheetPanel::exportTo(const QString& file) {
  plots::exportPlot(*plot_->plot(), file, [this] { return plot_->toCsv(); });
}

}  // namespace pliant::panels
