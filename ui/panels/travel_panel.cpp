#include "ui/panels/travel_panel.hpp"

#include <QCheckBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QToolButton>
#include <optional>

#include "core/scene/polar_curves.hpp"
#include "ui/plots/polar_plot.hpp"

namespace pliant::panels {

namespace {

/// None if there is nothing to show.
std::optional<scene::PolarCurves> curvesOf(const scene::Result* result) {
  if (const auto* travel = dynamic_cast<const scene::FreeTravelResult*>(result))
    return scene::freeTravelCurves(*travel);
  if (const auto* bending = dynamic_cast<const scene::CurvatureLimitsResult*>(result))
    return scene::curvatureLimitCurves(*bending);
  return std::nullopt;
}

}  // namespace

TravelPanel::TravelPanel(document::Document& document, QWidget* parent)
    : StudyPanel(document, {"free_travel", "curvature_limits"}, parent) {
  connect(addButton(tr("Measured…"), tr("Import measured values: a table with the columns angle [deg], the name of a "
                                        "curve, such as stretch [%] or bent up [1/m],\nand, if known, error or lower "
                                        "and upper")),
          &QToolButton::clicked, this, &TravelPanel::chooseMeasured);
  plot_ = new plots::PolarPlot;
  connect(&document_, &document::Document::sceneReplaced, plot_, &plots::PolarPlot::clearMeasured);
  setPlot(plot_);
}

QString TravelPanel::absentNote() const {
  return tr(
      "Studies of the types free_travel and curvature_limits find how far an interlocking material stretches, "
      "compresses or bends in each direction. This scene has none; add one in the scene's tree.");
}

QString TravelPanel::waitingNote(const QString& study) const {
  return tr("The study “%1” finds the limits of this material in each direction.").arg(study);
}

bool TravelPanel::present(const document::StudyState* study) {
  const auto result = study ? study->result : nullptr;
  const auto curves = curvesOf(result.get());
  if (result != result_) {
    result_ = result;
    plot_->setCurves(curves.value_or(scene::PolarCurves()));
    refreshSwitches();
  }
  plot_->setStale(study && study->stale);
  return curves.has_value();
}

/// A box a curve, in its colour.
void TravelPanel::refreshSwitches() {
  const auto& curves = plot_->curves().curves;
  if (switches()->count() == static_cast<int>(curves.size())) return;
  while (QLayoutItem* item = switches()->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  for (int i = 0; i < static_cast<int>(curves.size()); ++i) {
    auto* box = new QCheckBox(QString::fromStdString(curves[static_cast<std::size_t>(i)].name));
    box->setChecked(plot_->isCurveVisible(i));
    connect(box, &QCheckBox::toggled, this, [this, i](bool on) { plot_->setCurveVisible(i, on); });
    switches()->addWidget(box);
  }
}

void TravelPanel::importMeasured(const QString& file) {
  QStringList names;
  for (const scene::PolarCurve& curve : plot_->curves().curves) names << QString::fromStdString(curve.name);
  plot_->addMeasured(plots::readMeasuredTable(file, names));
}

void TravelPanel::chooseMeasured() {
  const QString file = QFileDialog::getOpenFileName(
      this, tr("Measured values: angle [deg] and the name of a curve"), {}, tr("Comma-separated values (*.csv)"));
  if (!file.isEmpty()) attempt([&] { importMeasured(file); });
}

void TravelPanel::exportTo(const QString& file) { plot_->exportTo(file); }

}  // namespace pliant::panels
