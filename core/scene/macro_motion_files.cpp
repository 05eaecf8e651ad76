#include <cmath>

#include "core/scene/csv.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/element_table.hpp"
#include "core/scene/frame_ply.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_result.hpp"
#include "core/scene/result_folder.hpp"

namespace pliant::scene {

namespace {

std::string nativeFileName(std::size_t frame) {
  char name[40];
  std::snprintf(name, sizeof(name), "frames/native_%05zu.csv", frame);
  return name;
}

FramePly macroFrames(const interlock::MacroSheet& sheet) {
  return {"positions in metres, gauges 1 at the limit",
          {"stretch_gauge", "bending_gauge"},
          sheet.mesh.triangles,
          static_cast<long>(sheet.mesh.points.cols())};
}

}  // namespace

void MacroResult::writeSteps(ResultFolder& folder) const {
  CsvWriter csv;
  for (const char* column :
       {"time [s]", "kinetic [J]", "elastic [J]", "potential [J]", "limits [J]", "contact [J]", "total [J]",
        "stretch_gauge", "bending_gauge", "smallest_gap [m]", "grip_lag [m]", "body_lag [m]", "residual", "iterations",
        "dissipated [J]", "sliding_share", "friction_lag"})
    csv.add(column);
  csv.endRow();
  for (const MacroStepRecord& step : steps) {
    const interlock::MacroEnergies& e = step.energies;
    csv.add(step.time).add(e.kinetic).add(e.elastic).add(e.potential).add(e.limits).add(e.contact).add(e.total());
    csv.add(step.stretchGauge).add(step.bendingGauge);
    std::isfinite(step.smallestGap) ? csv.add(step.smallestGap) : csv.add("");
    csv.add(step.gripLag).add(step.bodyLag).add(step.residual).add(step.iterations);
    csv.add(e.dissipated).add(step.friction.slidingShare).add(step.friction.lag).endRow();
  }
  folder.writeFile("steps.csv", csv.text());
}

void MacroResult::writeFrames(ResultFolder& folder) const {
  std::filesystem::create_directories(folder.path("frames"));
  const FramePly format = macroFrames(*sheet);
  CsvWriter list;
  list.add("frame").add(isMotion() ? "time [s]" : "part of the loads");
  if (native) list.add("elements off the sheet [m]");
  list.endRow();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    folder.writeFile(
        frameFileName(i), format.write(frames[i]->positions, {&frames[i]->stretchGauge, &frames[i]->bendingGauge}));
    list.add(static_cast<long>(i)).add(frames[i]->time);
    if (native) {
      list.add(frames[i]->nativeDistance);
      folder.writeFile(nativeFileName(i), elementTable(*frames[i]->native));
    }
    list.endRow();
  }
  folder.writeFile("frames.csv", list.text());
}

void readMacroSteps(const std::filesystem::path& directory, MacroResult& result) {
  const CsvTable steps(directory / "steps.csv");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    MacroStepRecord& step = result.steps.emplace_back();
    step.time = steps.number(i, "time [s]");
    step.energies = {steps.number(i, "kinetic [J]"), steps.number(i, "elastic [J]"), steps.number(i, "potential [J]"),
                     steps.number(i, "limits [J]"),  steps.number(i, "contact [J]"), steps.number(i, "dissipated [J]")};
    step.friction.slidingShare = steps.number(i, "sliding_share");
    step.friction.lag = steps.number(i, "friction_lag");
    step.stretchGauge = steps.number(i, "stretch_gauge");
    step.bendingGauge = steps.number(i, "bending_gauge");
    step.smallestGap = steps.text(i, "smallest_gap [m]").empty() ? std::numeric_limits<double>::infinity()
                                                                 : steps.number(i, "smallest_gap [m]");
    step.gripLag = steps.number(i, "grip_lag [m]");
    step.bodyLag = steps.number(i, "body_lag [m]");
    step.residual = steps.number(i, "residual");
    step.iterations = steps.integer(i, "iterations");
  }
}

void readMacroFrames(const std::filesystem::path& directory, MacroResult& result) {
  const FramePly format = macroFrames(*result.sheet);
  const CsvTable list(directory / "frames.csv");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string text = readTextFile(directory / frameFileName(i));
    auto frame = std::make_shared<MacroFrame>();
    frame->time = list.number(i, result.isMotion() ? "time [s]" : "part of the loads");
    locate((directory / frameFileName(i)).string(), [&] {
      format.read(text, frame->positions, {&frame->stretchGauge, &frame->bendingGauge});
    });
    // Where paths want bodies, from which they are away only where the sheet could not give way.
    frame->bodyPoints = mechanics::bodyPointsAt(result.bodies, result.isMotion() ? frame->time : 0);
    if (result.native && result.native->patch) {
      frame->native = readElementTable(directory / nativeFileName(i), *result.native->patch);
      frame->nativeDistance = list.number(i, "elements off the sheet [m]");
    }
    result.frames.push_back(std::move(frame));
  }
}

}  // namespace pliant::scene
