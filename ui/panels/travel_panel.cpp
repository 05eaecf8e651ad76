#include "ui/panels/travel_panel.hpp"

#include <QCheckBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <optional>

#include "core/scene/element_design_chart.hpp"
#include "core/scene/polar_curves.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/polar_plot.hpp"

namespace pliant::panels {

namespace {

/// None if there is nothing to show.
std::optional<scene::PolarCurves> curvesOf(const scene::Result* result) {
  if (const auto* travel = dynamic_cast<const scene::FreeTravelResult*>(result))
    return scene::freeTravelCurves(*travel);
  if (const auto* bending = dynamic_cast<const scene::CurvatureLimitsResult*>(result))
    return scene::curvatureLimitCurves(*bending);
  if (const auto* design = dynamic_cast<const scene::ElementDesignStudyResult*>(result);
      design && !design->design.history.empty())
    return scene::elementDesignCurves(scene::designedLimits(*design));
  return std::nullopt;
}

}  // namespace

TravelPanel::TravelPanel(document::Document& document, QWidget* parent)
    : StudyPanel(document, {"free_travel", "curvature_limits", "element_design"}, parent) {
  connect(addButton(tr("Measured…"), tr("Import measured values: a table with the columns angle [deg], the name of a "
                                        "curve, such as stretch [%] or bent up [1/m],\nand, if known, error or lower "
                                        "and upper")),
          &QToolButton::clicked, this, &TravelPanel::chooseMeasured);
  plot_ = new plots::PolarPlot;
  connect(&document_, &document::Document::sceneReplaced, plot_, &plots::PolarPlot::clearMeasured);
  auto* shown = new QWidget;
  auto* column = new QVBoxLayout(shown);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(plot_, 1);
  summary_ = new QLabel;
  summary_->setWordWrap(true);
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  take_ = new QPushButton(tr("Take This Element"));
  take_->setToolTip(tr("Puts its numbers into the scene; undo brings the old ones back"));
  connect(take_, &QPushButton::clicked, this, &TravelPanel::takeElement);
  designRow_ = new QWidget;
  auto* foot = new QHBoxLayout(designRow_);
  foot->setContentsMargins(16, 4, 16, 8);
  foot->addWidget(summary_, 1);
  foot->addWidget(take_);
  column->addWidget(designRow_);
  designRow_->hide();
  setPlot(shown);
}

QString TravelPanel::absentNote() const {
  return tr(
      "Studies of the types free_travel and curvature_limits find how far an interlocking material stretches, "
      "compresses or bends in each direction, and those of the type element_design find an element for wanted "
      "limits. This scene has none; add one in the scene's tree.");
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
  refreshDesign(study && isBusy(*study));
  return curves.has_value();
}

QString TravelPanel::summary() const { return summary_->text(); }

void TravelPanel::refreshDesign(bool busy) {
  const auto* result = dynamic_cast<const scene::ElementDesignStudyResult*>(result_.get());
  const bool isDesign = result && !result->design.history.empty();
  designRow_->setVisible(isDesign);
  if (!isDesign) return;
  plot_->setEmptyText(tr("Wanted is a region of strain space, no single directions."));
  const auto &before = result->design.history.front(), &best = result->design.best();
  QStringList numbers;
  for (std::size_t i = 0; i < result->numbers.size(); ++i) {
    const auto& parameter = result->numbers[i].parameter;
    const auto text = [&](double value) { return QString::fromStdString(rounded(value, parameter.dimension).text); };
    const auto index = static_cast<Eigen::Index>(i);
    numbers << tr("%1 %2 → %3")
                   .arg(QString::fromStdString(parameter.name).replace('_', ' '), text(before.values[index]),
                        text(best.values[index]));
  }
  const auto percent = [](double strain) { return QString::number(100 * strain, 'g', 3); };
  QString end;
  if (busy)
    end = tr("running, iteration %1").arg(best.iteration);
  else if (result->design.end == interlock::DesignEnd::reached)
    end = tr("the limits wanted are reached");
  else if (result->design.end == interlock::DesignEnd::stationary)
    end = tr("no small change brings all limits nearer");
  else if (result->design.end == interlock::DesignEnd::kink)
    end = tr("contacts change here, and no step found better limits");
  else
    end = QString::fromStdString(result->message);
  summary_->setText(tr("Off the wanted limits by %1 % → %2 % (root mean square); gaps at rest %3 → %4; %5.\n%6")
                        .arg(percent(before.residual), percent(best.residual),
                             QString::fromStdString(rounded(before.clearance, base::dimensions::length).text),
                             QString::fromStdString(rounded(best.clearance, base::dimensions::length).text), end,
                             numbers.join(QStringLiteral(",  "))));
  take_->setEnabled(!busy);
}

void TravelPanel::takeElement() {
  const auto* result = dynamic_cast<const scene::ElementDesignStudyResult*>(result_.get());
  if (!result || document_.isEmpty()) return;
  attempt([&] {
    document_.setValue("", scene::designedElementScene(document_.scene(), *result, result->design.best()),
                       tr("Take the element found"));
  });
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
