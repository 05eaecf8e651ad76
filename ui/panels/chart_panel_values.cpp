#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/calibration_result.hpp"
#include "core/scene/design_space_result.hpp"
#include "core/scene/designed_scene.hpp"
#include "ui/panels/chart_panel.hpp"
#include "ui/panels/value_card.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

QString quantity(double value, const base::Dimension& dimension) {
  return QString::fromStdString(rounded(value, dimension).text);
}

/// "wing tip path length 78.1 mm", a measure each.
QStringList measureTexts(const scene::DesignSpaceResult& space, const harmonic::SampledDesign& design) {
  QStringList list;
  for (const scene::DesignMeasure& measure : space.measures) {
    const double value = measure.of(design);
    list += QString::fromStdString(measure.name(*space.model)) + ' ' +
            (measure.kind == scene::DesignMeasure::Kind::totalMass ? quantity(value, base::dimensions::mass)
                                                                   : plots::formatLength(value));
  }
  return list;
}

const mechanics::DesignParameter& parameterOf(const scene::DesignSpaceResult& space, std::size_t row) {
  return *space.model->parameters[static_cast<std::size_t>(space.parameters[row])];
}

}  // namespace

void ChartPanel::chooseDesign(int design) {
  if (design == chosen_ || !hasMotion(design)) {
    leaveDesign();
    return;
  }
  chosen_ = design;
  for (plots::LinePlot* plot : plots_) plot->setChosenItem(chosen_);
  refreshCard();
  const harmonic::SampledDesign& sampled = space_->space.designs[static_cast<std::size_t>(design)];
  Q_EMIT designChosen({std::make_shared<const harmonic::HarmonicBalanceProblem>(
                           sampled.model, math::HarmonicBasis(space_->harmonics, space_->samples)),
                       sampled.z,
                       tr("design %1 of %2:  %3")
                           .arg(design)
                           .arg(QString::fromStdString(study()), measureTexts(*space_, sampled).join(", "))});
}

bool ChartPanel::hasMotion(int design) const {
  return space_ && design >= 0 && design < static_cast<int>(space_->space.designs.size()) &&
         space_->space.designs[static_cast<std::size_t>(design)].model;
}

void ChartPanel::leave() {
  chosen_ = -1;
  for (plots::LinePlot* plot : plots_) plot->setChosenItem(-1);
  refreshCard();
}

void ChartPanel::leaveDesign() {
  if (chosen_ < 0) return;
  leave();
  Q_EMIT designLeft();
}

QString ChartPanel::designText(int design) const {
  if (!hasMotion(design)) return {};
  constexpr std::size_t mostParameters = 6;
  const harmonic::SampledDesign& sampled = space_->space.designs[static_cast<std::size_t>(design)];
  QStringList lines = measureTexts(*space_, sampled);
  lines.prepend(design == 0 ? tr("the scene's design") : tr("design %1").arg(design));
  for (std::size_t i = 0; i < std::min(mostParameters, space_->parameters.size()); ++i) {
    const mechanics::DesignParameter& parameter = parameterOf(*space_, i);
    lines += tr("%1:  %2").arg(QString::fromStdString(parameter.name()),
                               quantity(sampled.values[static_cast<Eigen::Index>(i)], parameter.dimension()));
  }
  if (space_->parameters.size() > mostParameters) lines += QStringLiteral("…");
  return lines.join('\n');
}

void ChartPanel::refreshCard() {
  const bool fitted = fit_ && !fit_->calibration.history.empty();
  card_->setVisible(fitted || chosen_ >= 0);
  if (fitted)
    showFit(*fit_);
  else if (chosen_ >= 0)
    showDesign(*space_);
}

void ChartPanel::showDesign(const scene::DesignSpaceResult& space) {
  const harmonic::SampledDesign& design = space.space.designs[static_cast<std::size_t>(chosen_)];
  std::vector<QStringList> rows;
  for (std::size_t i = 0; i < space.parameters.size(); ++i) {
    const mechanics::DesignParameter& parameter = parameterOf(space, i);
    const double low = parameter.minimum(*space.model), high = parameter.maximum(*space.model);
    const double value = design.values[static_cast<Eigen::Index>(i)];
    rows.push_back({QString::fromStdString(parameter.name()),
                    quantity(parameter.value(*space.model), parameter.dimension()),
                    quantity(value, parameter.dimension()),
                    QStringLiteral("%1 %").arg(100 * (value - low) / (high - low), 0, 'f', 0)});
  }
  card_->setTitle(tr("Design %1:  %2").arg(chosen_).arg(measureTexts(space, design).join(QStringLiteral(",  "))));
  card_->setTable({tr("parameter"), tr("before"), tr("this design"), tr("of its range")}, rows);
  card_->takeButton()->setText(tr("Take This Design"));
  card_->takeButton()->setToolTip(tr("Puts its parameters into the scene; undo brings the old ones back"));
}

void ChartPanel::showFit(const scene::CalibrationStudyResult& fit) {
  const harmonic::CalibrationResult& found = fit.calibration;
  const harmonic::CalibrationIterate &first = found.history.front(), &last = found.history.back();
  std::vector<QStringList> rows;
  for (std::size_t i = 0; i < found.before->parameters.size(); ++i) {
    const mechanics::DesignParameter& parameter = *found.before->parameters[i];
    const auto index = static_cast<Eigen::Index>(i);
    const double halfWidth = found.uncertainty.halfWidths[index];
    const int bound = found.atBound[i];
    rows.push_back({QString::fromStdString(parameter.name()), quantity(first.values[index], parameter.dimension()),
                    quantity(last.values[index], parameter.dimension()),
                    bound != 0                 ? (bound < 0 ? tr("at its minimum") : tr("at its maximum"))
                    : std::isfinite(halfWidth) ? QStringLiteral("± ") + quantity(halfWidth, parameter.dimension())
                                               : tr("not determined")});
  }
  card_->setTitle(tr("Residuals %1 → %2 (root mean square)")
                      .arg(plots::formatLength(first.rootMeanSquare), plots::formatLength(last.rootMeanSquare)));
  card_->setTable({tr("parameter"), tr("before"), tr("fitted"), tr("%1 %").arg(100 * fit.confidence, 0, 'g', 3)}, rows);
  card_->takeButton()->setText(tr("Take Fitted Values"));
  card_->takeButton()->setToolTip(tr("Puts the fitted values into the scene; undo brings the old ones back"));
}

void ChartPanel::takeValues() {
  if (document_.isEmpty()) return;
  attempt([this] {
    if (fit_ && !fit_->calibration.history.empty()) {
      std::vector<int> all(fit_->calibration.before->parameters.size());
      std::iota(all.begin(), all.end(), 0);
      document_.setValue("",
                         scene::sceneWithValues(document_.scene(), *fit_->calibration.before, all,
                                                fit_->calibration.history.back().values),
                         tr("Take fitted values"));
    } else if (space_ && chosen_ >= 0) {
      const harmonic::SampledDesign& design = space_->space.designs[static_cast<std::size_t>(chosen_)];
      const int taken = chosen_;
      document_.setValue("",
                         scene::sceneWithValues(document_.scene(), *space_->model, space_->parameters, design.values),
                         tr("Take design %1 of %2").arg(taken).arg(QString::fromStdString(study())));
      leaveDesign();
    }
  });
}

}  // namespace pliant::panels
