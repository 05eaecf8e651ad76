#include "ui/panels/chart_panel.hpp"

#include <QPointer>
#include <QPushButton>
#include <QSplitter>
#include <QTemporaryDir>
#include <algorithm>

#include "core/scene/calibration_chart.hpp"
#include "core/scene/calibration_result.hpp"
#include "core/scene/design_space_chart.hpp"
#include "core/scene/design_space_result.hpp"
#include "ui/panels/value_card.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_export.hpp"

namespace pliant::panels {

namespace {

const QString topic = QStringLiteral("charts of a result");

/// From the files that the result writes, which charts are made of.
std::vector<scene::ResultChart> chartsOf(const scene::Result& result) {
  const QTemporaryDir folder;
  const std::filesystem::path place = folder.path().toStdString();
  result.write(place);
  const scene::Json summary = result.summary();
  return result.kind() == "calibration" ? scene::calibrationCharts(place, summary)
                                        : scene::designSpaceCharts(place, summary);
}

plots::LineChart lineChart(const scene::ResultChart& chart) {
  plots::LineChart lines;
  lines.xLabel = QString::fromStdString(chart.xLabel);
  lines.yLabel = QString::fromStdString(chart.yLabel);
  lines.logarithmicY = chart.logarithmicY;
  for (const scene::ResultSeries& series : chart.series) {
    plots::PlotLine line;
    line.name = QString::fromStdString(series.name);
    line.x = series.x;
    line.y = series.y;
    line.group = series.group;
    line.dashed = series.mark == scene::ResultSeries::Mark::dashedLine;
    line.dots = series.mark == scene::ResultSeries::Mark::points;
    line.joined = !line.dots;
    line.items = series.designs;
    lines.lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

ChartPanel::ChartPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent)
    : StudyPanel(document, {"calibration", "design_space"}, parent), quick_(quick) {
  split_ = new QSplitter(Qt::Horizontal);
  split_->setChildrenCollapsible(false);
  card_ = new ValueCard;
  card_->hide();
  split_->addWidget(card_);
  connect(card_->takeButton(), &QPushButton::clicked, this, &ChartPanel::takeValues);
  setPlot(split_);
}

ChartPanel::~ChartPanel() = default;

bool ChartPanel::hasStudies() const {
  const auto& studies = document_.studies();
  return std::any_of(studies.begin(), studies.end(), [this](const auto& study) { return shows(study.type); });
}

QString ChartPanel::absentNote() const {
  return tr(
      "Studies of the types calibration and design_space are shown here. This scene has none; add one in the "
      "scene's tree.");
}

QString ChartPanel::waitingNote(const QString& study) const {
  const document::StudyState* state = document_.study(study.toStdString());
  return state && state->type == "calibration"
             ? tr("The study “%1” fits parameters to measured motions.").arg(study)
             : tr("The study “%1” shows what can be reached between the bounds of the parameters.").arg(study);
}

bool ChartPanel::present(const document::StudyState* study) {
  const auto result = study ? study->result : nullptr;
  if (result == result_) return !plots_.empty();
  result_ = result;
  const auto space = std::dynamic_pointer_cast<const scene::DesignSpaceResult>(result);
  const std::string name = study ? study->name : std::string();
  const bool same = space && space_ && space->model == space_->model && name == of_;
  if (!same) leaveDesign();
  of_ = name;
  space_ = space;
  if (chosen_ >= 0 && !hasMotion(chosen_)) leaveDesign();  // while a space is filled its designs keep their numbers
  fit_ = std::dynamic_pointer_cast<const scene::CalibrationStudyResult>(result);
  refreshCard();
  if (!result) showCharts({});
  if (!result) return false;
  jobs::Job job;
  job.topic = topic;
  job.work = [panel = QPointer<ChartPanel>(this), result](
                 base::ExecutionContext&, const jobs::Publish&) -> jobs::Delivery {
    return [panel, result, charts = chartsOf(*result)] {
      ChartPanel* self = panel.data();
      if (!self || self->result_ != result) return;
      self->showCharts(charts);
      self->refresh();
    };
  };
  quick_.submit(std::move(job));
  return !plots_.empty();
}

/// Plots stay where there are as many as before, so that a growing result does not flicker.
void ChartPanel::showCharts(const std::vector<scene::ResultChart>& charts) {
  for (; plots_.size() > charts.size(); plots_.pop_back()) plots_.back()->deleteLater();
  while (plots_.size() < charts.size()) {
    auto* plot = new plots::LinePlot;
    plot->setMinimumWidth(160);
    plot->setItemText([this](int design) { return designText(design); });
    connect(plot, &plots::LinePlot::itemChosen, this, &ChartPanel::chooseDesign);
    split_->insertWidget(static_cast<int>(plots_.size()), plot);
    split_->setStretchFactor(static_cast<int>(plots_.size()), 1);
    plots_.push_back(plot);
  }
  for (std::size_t i = 0; i < charts.size(); ++i) {
    plots_[i]->setAccessibleName(QString::fromStdString(charts[i].title));
    plots_[i]->setChart(lineChart(charts[i]));
    plots_[i]->setChosenItem(chosen_);
  }
}

void ChartPanel::exportTo(const QString& file) {
  if (plots_.empty()) return;
  plots::exportPlot(*plots_.front()->plot(), file, [this] { return plots_.front()->toCsv(); });
}

}  // namespace pliant::panels
