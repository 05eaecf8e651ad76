#include "ui/panels/cloth_charts.hpp"

#include <QObject>
#include <cmath>
#include <functional>

namespace pliant::panels {

using plots::LineChart;
using plots::PlotLine;
using scene::ClothStepRecord;

namespace {

/// A number of every step over time.
PlotLine overTime(const ClothRun& run, const QString& name, int group,
                  const std::function<double(const ClothStepRecord&)>& value) {
  PlotLine line;
  line.name = name;
  line.group = group;
  for (const ClothStepRecord& step : run.result->steps) {
    line.x.push_back(step.time);
    line.y.push_back(value(step));
  }
  return line;
}

/// A drape counts its steps.
QString timeLabel(const std::vector<ClothRun>& runs) {
  return !runs.empty() && runs[0].countsSteps ? QObject::tr("Step") : QObject::tr("Time  [s]");
}

LineChart totalEnergies(const std::vector<ClothRun>& runs) {
  LineChart chart{timeLabel(runs), QObject::tr("Total energy  [J]"), false, {}};
  for (const ClothRun& run : runs)
    chart.lines.push_back(
        overTime(run, run.name, run.group, [](const ClothStepRecord& step) { return step.energies.total(); }));
  return chart;
}

LineChart energyParts(const std::vector<ClothRun>& runs) {
  LineChart chart{timeLabel(runs), QObject::tr("Energy  [J]"), false, {}};
  const std::pair<QString, double cloth::Energies::*> parts[] = {
      {QObject::tr("kinetic"), &cloth::Energies::kinetic}, {QObject::tr("membrane"), &cloth::Energies::membrane},
      {QObject::tr("bending"), &cloth::Energies::bending}, {QObject::tr("gravity"), &cloth::Energies::gravity},
      {QObject::tr("other"), &cloth::Energies::other},     {QObject::tr("contact"), &cloth::Energies::contact}};
  if (runs.empty()) return chart;
  int group = 1;
  chart.lines.push_back(
      overTime(runs[0], QObject::tr("total"), 0, [](const ClothStepRecord& step) { return step.energies.total(); }));
  for (const auto& [name, part] : parts) {
    PlotLine line =
        overTime(runs[0], name, group++, [part = part](const ClothStepRecord& step) { return step.energies.*part; });
    const bool any = std::any_of(line.y.begin(), line.y.end(), [](double value) { return value != 0; });
    if (any) chart.lines.push_back(std::move(line));
  }
  return chart;
}

LineChart violations(const std::vector<ClothRun>& runs) {
  LineChart chart{timeLabel(runs), QObject::tr("Stretch over limit − 1"), true, {}};
  for (const ClothRun& run : runs)
    chart.lines.push_back(
        overTime(run, run.name, run.group, [](const ClothStepRecord& step) { return step.violation; }));
  return chart;
}

LineChart projectionGaps(const std::vector<ClothRun>& runs) {
  LineChart chart{timeLabel(runs), QObject::tr("Relative gap, violation"), true, {}};
  if (runs.empty()) return chart;
  chart.lines = {
      overTime(runs[0], QObject::tr("relative gap"), 0, [](const ClothStepRecord& step) { return step.relativeGap; }),
      overTime(runs[0], QObject::tr("violation"), 1, [](const ClothStepRecord& step) { return step.violation; })};
  return chart;
}

LineChart iterations(const std::vector<ClothRun>& runs) {
  LineChart chart{timeLabel(runs), QObject::tr("Iterations in a step"), false, {}};
  if (runs.empty()) return chart;
  chart.lines = {overTime(runs[0], QObject::tr("projection"), 0,
                          [](const ClothStepRecord& step) { return double(step.projectionIterations); }),
                 overTime(runs[0], QObject::tr("Newton"), 1,
                          [](const ClothStepRecord& step) { return double(step.newtonIterations); })};
  return chart;
}

LineChart lastProjection(const std::vector<ClothRun>& runs) {
  LineChart chart{QObject::tr("Iteration"), QObject::tr("Relative gap, violation"), true, {}};
  if (runs.empty()) return chart;
  PlotLine gap{QObject::tr("relative gap"), {}, {}, 0, false, true};
  PlotLine violation{QObject::tr("violation"), {}, {}, 1, false, true};
  for (const base::IterationRecord& record : runs[0].result->lastProjection.iterations) {
    for (PlotLine* line : {&gap, &violation}) line->x.push_back(record.iteration);
    gap.y.push_back(record.residual);
    violation.y.push_back(record.correction);
  }
  chart.lines = {gap, violation};
  return chart;
}

LineChart distances(const std::vector<ClothRun>& runs) {
  LineChart chart{timeLabel(runs), QObject::tr("Smallest distance  [mm]"), false, {}};
  for (const ClothRun& run : runs)
    chart.lines.push_back(
        overTime(run, run.name, run.group, [](const ClothStepRecord& step) { return 1e3 * step.smallestGap; }));
  return chart;
}

}  // namespace

const std::vector<ClothChartKind>& clothChartKinds() {
  static const std::vector<ClothChartKind> kinds{
      {QObject::tr("Total energy"), QObject::tr("How much energy each method keeps"), true, true, &totalEnergies},
      {QObject::tr("Parts of the energy"), QObject::tr("Where the energy of one study is"), false, true, &energyParts},
      {QObject::tr("Violation of the limits"),
       QObject::tr("How far the stretch that is nearest to its limit lies beyond it"), true, true, &violations},
      {QObject::tr("Gap of the projections"), QObject::tr("How exactly each step is projected onto the limits"), false,
       true, &projectionGaps},
      {QObject::tr("Iterations"), QObject::tr("What each step takes"), false, true, &iterations},
      {QObject::tr("Last projection"), QObject::tr("How the last projection converges"), false, false, &lastProjection},
      {QObject::tr("Distance"), QObject::tr("The smallest distance to bodies and to itself"), true, true, &distances}};
  return kinds;
}

}  // namespace pliant::panels
