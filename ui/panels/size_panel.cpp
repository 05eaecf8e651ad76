#include "ui/panels/size_panel.hpp"

#include "core/scene/bending_chart.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_export.hpp"

namespace pliant::panels {

namespace {

plots::LineChart chartOf(const scene::BendingSizeResult& result) {
  const scene::ResultChart chart = scene::bendingSizeChart(result);
  plots::LineChart lines;
  lines.xLabel = QString::fromStdString(chart.xLabel);
  lines.yLabel = QString::fromStdString(chart.yLabel);
  lines.fromZero = true;
  for (const scene::ResultSeries& series : chart.series) {
    if (series.mark == scene::ResultSeries::Mark::points) continue;  // lines mark theirs here
    plots::PlotLine line;
    line.name = QString::fromStdString(series.name);
    line.x = series.x;
    line.y = series.y;
    line.group = series.group;
    line.dashed = series.mark == scene::ResultSeries::Mark::dashedLine;
    line.dots = true;
    lines.lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

SizePanel::SizePanel(document::Document& document, QWidget* parent) : StudyPanel(document, {"bending_size"}, parent) {
  plot_ = new plots::LinePlot;
  plot_->setAccessibleName(tr("Limits of curvature over the size of the patch"));
  setPlot(plot_);
}

QString SizePanel::absentNote() const {
  return tr(
      "A study of the type bending_size finds how far patches of several sizes bend. This scene has none; add one "
      "in the scene's tree.");
}

QString SizePanel::waitingNote(const QString& study) const {
  return tr("The study “%1” finds how far patches of several sizes bend.").arg(study);
}

bool SizePanel::present(const document::StudyState* study) {
  const auto result = study ? study->result : nullptr;
  if (result != result_) {
    result_ = result;
    const auto* sizes = dynamic_cast<const scene::BendingSizeResult*>(result.get());
    plots::LineChart chart = sizes ? chartOf(*sizes) : plots::LineChart();
    if (!chart.lines.empty())
      plot_->setChart(std::move(chart));
    else
      plot_->setNote(study && isBusy(*study) ? tr("The first limits are on their way.")
                                             : tr("No limit: all of these patches fold."));
  }
  return result != nullptr;
}

void SizePanel::exportTo(const QString& file) {
  plots::exportPlot(*plot_->plot(), file, [this] { return plot_->toCsv(); });
}

}  // namespace pliant::panels
