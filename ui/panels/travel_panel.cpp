#include "ui/panels/travel_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedLayout>
#include <QToolButton>
#include <algorithm>
#include <optional>

#include "core/base/error.hpp"
#include "core/scene/element_design_chart.hpp"
#include "core/scene/polar_curves.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/plot_export.hpp"
#include "ui/plots/polar_plot.hpp"

namespace pliant::panels {

namespace {

constexpr int controlHeight = 28;

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

bool TravelPanel::shows(const std::string& type) {
  return type == "free_travel" || type == "curvature_limits" || type == "element_design";
}

TravelPanel::TravelPanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
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

  auto* shown = new QWidget;
  studies_ = new QComboBox;
  studies_->setToolTip(tr("Whose limits are shown"));
  studies_->setFixedHeight(controlHeight);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(16, 4, 16, 4);
  head->setSpacing(8);
  head->addWidget(studies_);
  switches_ = new QHBoxLayout;
  switches_->setSpacing(12);
  head->addLayout(switches_);
  head->addStretch();
  const auto button = [&](const QString& text, const QString& tooltip, auto act) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setToolTip(tooltip);
    made->setFixedHeight(controlHeight);
    connect(made, &QToolButton::clicked, this, act);
    head->addWidget(made);
  };
  button(tr("Measured…"),
         tr("Import measured values: a table with the columns angle [deg], the name of a curve, such as stretch [%] "
            "or bent up [1/m],\nand, if known, error or lower and upper"),
         &TravelPanel::chooseMeasured);
  button(tr("Export…"), tr("Write the plot as PDF, SVG or PNG, or its numbers as CSV"), &TravelPanel::exportPlot);
  plot_ = new plots::PolarPlot;
  auto* column = new QVBoxLayout(shown);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(plot_, 1);
  summary_ = new QLabel;
  summary_->setWordWrap(true);
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  take_ = new QPushButton(tr("Take This Element"));
  take_->setToolTip(tr("Puts its numbers into the scene; undo brings the old ones back"));
  designRow_ = new QWidget;
  auto* foot = new QHBoxLayout(designRow_);
  foot->setContentsMargins(16, 4, 16, 8);
  foot->addWidget(summary_, 1);
  foot->addWidget(take_);
  column->addWidget(designRow_);
  designRow_->hide();
  pages_ = new QStackedLayout(this);
  pages_->addWidget(empty);
  pages_->addWidget(shown);

  connect(run_, &QPushButton::clicked, this, [this] { Q_EMIT runRequested(study()); });
  connect(studies_, &QComboBox::activated, this, &TravelPanel::refresh);
  connect(take_, &QPushButton::clicked, this, &TravelPanel::takeElement);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    plot_->clearMeasured();
    fillStudies();
    refresh();
  });
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    fillStudies();
    refresh();
  });
  connect(&document_, &document::Document::studyChanged, this, [this](const std::string& name) {
    if (name == study()) refresh();
  });
  fillStudies();
  refresh();
}

std::string TravelPanel::study() const { return studies_->currentText().toStdString(); }

void TravelPanel::setStudy(const std::string& name) {
  const int index = studies_->findText(QString::fromStdString(name));
  if (index < 0) return;
  studies_->setCurrentIndex(index);
  refresh();
}

void TravelPanel::fillStudies() {
  const QString before = studies_->currentText();
  studies_->clear();
  for (const document::StudyState& study : document_.studies())
    if (shows(study.type)) studies_->addItem(QString::fromStdString(study.name));
  studies_->setCurrentIndex(std::max(0, studies_->findText(before)));
  studies_->setVisible(studies_->count() > 1);
}

void TravelPanel::refresh() {
  const document::StudyState* state = document_.study(study());
  const auto result = state ? state->result : nullptr;
  const auto curves = curvesOf(result.get());
  const bool busy =
      state && (state->status == document::StudyStatus::running || state->status == document::StudyStatus::waiting);
  run_->setVisible(state != nullptr);
  run_->setEnabled(!busy);
  run_->setText(tr("Run %1").arg(studies_->currentText()));
  note_->setText(
      !state ? tr("Studies of the types free_travel and curvature_limits find how far an interlocking "
                  "material stretches, compresses or bends in each direction, and those of the type element_design "
                  "find an element for wanted limits. This scene has none; add one in the scene's tree.")
      : busy ? tr("The limits are on their way.")
             : tr("The study “%1” finds the limits of this material in each direction.").arg(studies_->currentText()));
  pages_->setCurrentIndex(curves ? 1 : 0);
  if (result != result_) {
    result_ = result;
    plot_->setCurves(curves.value_or(scene::PolarCurves()));
    refreshSwitches();
  }
  plot_->setStale(state && state->stale);
  refreshDesign(busy);
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
  try {
    document_.setValue("", scene::designedElementScene(document_.scene(), *result, result->design.best()),
                       tr("Take the element found"));
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

/// A box a curve, in its colour.
void TravelPanel::refreshSwitches() {
  const auto& curves = plot_->curves().curves;
  if (switches_->count() == static_cast<int>(curves.size())) return;
  while (QLayoutItem* item = switches_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  for (int i = 0; i < static_cast<int>(curves.size()); ++i) {
    auto* box = new QCheckBox(QString::fromStdString(curves[static_cast<std::size_t>(i)].name));
    box->setChecked(plot_->isCurveVisible(i));
    connect(box, &QCheckBox::toggled, this, [this, i](bool on) { plot_->setCurveVisible(i, on); });
    switches_->addWidget(box);
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
  if (file.isEmpty()) return;
  try {
    importMeasured(file);
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

void TravelPanel::exportPlot() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Export the plot"), {}, plots::plotExportFilters());
  if (file.isEmpty()) return;
  try {
    plot_->exportTo(file);
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::panels
