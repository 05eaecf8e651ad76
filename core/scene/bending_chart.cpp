#include "core/scene/bending_chart.hpp"

#include <cmath>

namespace pliant::scene {

ResultChart bendingSizeChart(const BendingSizeResult& result) {
  using Mark = ResultSeries::Mark;
  struct Line {
    const char* name;
    int group;
    bool up;
  };
  // In the order of BendingSizeResult::names.
  constexpr std::array<Line, BendingSizeResult::names.size()> lines{{{"one direction", 0, true},
                                                                     {"dome, up", 1, true},
                                                                     {"dome, down", 2, false},
                                                                     {"saddle, up along it", 3, true},
                                                                     {"saddle, down along it", 4, false}}};
  ResultChart chart;
  chart.title = result.provenance.study;
  chart.xLabel = "Radius of the patch  [mm]";
  chart.yLabel = "Largest curvature  [1/m]";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Mark mark = lines[i].up ? Mark::line : Mark::dashedLine;
    ResultSeries line{lines[i].name, mark, {}, {}, lines[i].group}, dots{"", Mark::points, {}, {}, lines[i].group};
    const auto finish = [&] {
      if (line.x.empty()) return;
      chart.series.push_back(line);
      line = {"", mark, {}, {}, lines[i].group};  // what goes on after a gap belongs to it
    };
    for (const BendingSizeResult::Size& size : result.sizes) {
      const interlock::BendingLimit& limit = size.limits[i];
      if (limit.kind != interlock::BendingKind::locked) {
        finish();
        continue;
      }
      for (ResultSeries* series : {&line, &dots}) {
        series->x.push_back(1e3 * size.radius);
        series->y.push_back(std::abs(limit.curvature));
      }
    }
    finish();
    if (!dots.x.empty()) chart.series.push_back(dots);
  }
  return chart;
}

}  // namespace pliant::scene
