#include <QComboBox>
#include <algorithm>
#include <cmath>

#include "ui/panels/sheet_panel.hpp"
#include "ui/plots/line_plot.hpp"

namespace pliant::panels {

namespace {

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

void SheetPanel::refreshPlot() {
  if (!result_) return;
  if (plots_->currentIndex() != motionPlot) plot_->setInstant(std::nan(""));
  switch (plots_->currentIndex()) {
    case deflectionPlot: return plotDeflections();
    case motionPlot: return plotMotion();
    default: plotNearness();
  }
}

void SheetPanel::plotNearness() {
  plots::LineChart chart;
  chart.xLabel = tr("share of triangles [%]");
  chart.yLabel = tr("strain / limit");
  chart.legendBelow = true;
  chart.fromZero = true;
  if (moment_.stretchGauge.size() > 0) chart.lines.push_back(sortedLine(tr("stretch"), moment_.stretchGauge, 0));
  if (moment_.bendingGauge.size() > 0 && moment_.bendingGauge.maxCoeff() > 0)
    chart.lines.push_back(sortedLine(tr("bending"), moment_.bendingGauge, 1));
  plot_->setChart(std::move(chart));
}

/// Of plots over time, which show loads in percent.
double SheetPanel::instantScale() const { return result_ && !result_->isMotion() ? 100 : 1; }

void SheetPanel::plotMotion() {
  plots::LineChart chart;
  chart.xLabel = result_->isMotion() ? tr("time [s]") : tr("share of the loads [%]");
  chart.yLabel = tr("largest strain / limit");
  chart.legendBelow = true;
  chart.fromZero = true;
  plots::PlotLine stretch, bending;
  stretch.name = tr("stretch");
  bending.name = tr("bending");
  bending.group = 1;
  bool bends = false;
  const auto add = [&](double time, double stretched, double bent) {
    stretch.x.push_back(time * instantScale());
    stretch.y.push_back(stretched);
    bending.x.push_back(time * instantScale());
    bending.y.push_back(bent);
    bends = bends || bent > 0;
  };
  for (const scene::MacroStepRecord& step : result_->steps) add(step.time, step.stretchGauge, step.bendingGauge);
  if (!result_->isMotion())
    for (const auto& frame : result_->frames)
      add(frame->time, frame->stretchGauge.maxCoeff(), frame->bendingGauge.maxCoeff());
  chart.lines.push_back(std::move(stretch));
  if (bends) chart.lines.push_back(std::move(bending));
  plot_->setChart(std::move(chart));
  plot_->setInstant(instant_ * instantScale());
}

void SheetPanel::plotDeflections() {
  plots::LineChart chart;
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

void SheetPanel::showDeflections() {
  plots_->setCurrentIndex(deflectionPlot);
  refreshPlot();
}

}  // namespace pliant::panels
