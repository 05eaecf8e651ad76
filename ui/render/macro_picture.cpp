#include "ui/render/macro_picture.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

namespace {

std::string numberText(double value) { return base::formatQuantity(value, {}); }

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f mm", 1e3 * metres);
  return text;
}

/// The largest of the triangles.
std::string gaugeText(const char* quantity, const Eigen::VectorXd& gauges) {
  if (gauges.size() == 0 || !(gauges.maxCoeff() > 0)) return {};
  char text[48];
  std::snprintf(text, sizeof(text), ",  %s up to %.3f", quantity, gauges.maxCoeff());
  return text;
}

/// How far it came, and how well its steps were solved.
std::string motionText(const scene::MacroResult& result) {
  double residual = 0;
  for (const scene::MacroStepRecord& step : result.steps) residual = std::max(residual, step.residual);
  return "\n" + std::to_string(result.steps.size()) + " steps to " +
         base::formatQuantity(result.steps.back().time, base::dimensions::time) + ",  residual up to " +
         numberText(residual) + (result.message.empty() ? "" : "\n" + result.message);
}

/// How well it rests.
std::string restText(const scene::MacroResult& result, const char* before) {
  const bool solved = !result.state.report.iterations.empty();
  return (solved ? before + ("residual " + numberText(result.state.report.residual())) : "") +
         (result.termination == base::TerminationType::converged ? "" : "\n" + result.message);
}

}  // namespace

std::string macroFrameLine(const scene::MacroFrame& frame, bool isMotion) {
  char time[32];
  if (isMotion)
    std::snprintf(time, sizeof(time), "t = %.3f s", frame.time);
  else
    std::snprintf(time, sizeof(time), "%.0f %% of the loads", 100 * frame.time);
  const std::string gauges = gaugeText("stretch", frame.stretchGauge) + gaugeText("bending", frame.bendingGauge);
  return time + (gauges.empty() || frame.native ? gauges : gauges + " of the limits");  // half a window is narrow
}

std::string nativeCaption(const scene::NativeComparison& native, double meanDistance) {
  char share[32];
  std::snprintf(share, sizeof(share), "%.1f %%", 100 * meanDistance / native.size);
  return std::to_string(native.patch->elements.size()) + " elements under the same loads\n" +
         millimetres(meanDistance) + " off the sheet in the mean,\n" + share + " of the patch" +
         (native.rest.converged() ? "" : "\nnot at rest: " + native.rest.message);
}

std::string macroCaption(const scene::MacroResult& result, bool nativeBeside) {
  double stretch = result.state.stretchGauge.maxCoeff();
  double bending = result.state.bendingGauge.size() > 0 ? result.state.bendingGauge.maxCoeff() : 0;
  for (const scene::MacroStepRecord& step : result.steps) {
    stretch = std::max(stretch, step.stretchGauge);
    bending = std::max(bending, step.bendingGauge);
  }
  std::string text = result.provenance.study + ":  " + std::to_string(result.sheet->mesh.triangles.size()) +
                     " triangles" + (nativeBeside ? "\n" : ",  ") + "stretch up to " + numberText(stretch) +
                     " of its limits";
  if (bending > 0) text += ",  bending up to " + numberText(bending);
  if (result.deflections.cols() > 0) {
    double largest = 0;
    for (Eigen::Index i = 0; i < result.deflections.cols(); ++i)
      largest = std::max(largest, result.deflections.col(i).norm());
    text += (nativeBeside ? "\nmoved by up to " : "\nloads moved by up to ") + millimetres(largest);
  }
  if (result.placed) {
    const auto& [detail, before, check] = *result.placed;
    text += "\n" + std::to_string(detail.elements.size()) + " elements,  " + std::to_string(check.links) + " links" +
            (check.lostLinks + check.newLinks == 0 ? " as at rest" : ", NOT as at rest") + ",  none nearer than " +
            numberText(1e6 * check.smallestDistance) + " µm,  at most " + millimetres(detail.pulls.maxCoeff()) +
            " off the sheet";
  }
  if (result.isMotion() && !result.steps.empty()) text += motionText(result);
  if (!result.isMotion()) text += restText(result, nativeBeside ? "\n" : ",  ");
  if (result.native && !nativeBeside)
    text += std::string(result.deflections.cols() > 0 ? ",  " : "\n") + "elements " +
            millimetres(result.native->meanDistance) + " off the sheet (at most " +
            millimetres(result.native->largestDistance) + ")";
  return text;
}

Image drawMacro(const std::shared_ptr<const scene::MacroResult>& result, const PictureOptions& options,
                std::optional<double> time, bool elements) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  MacroView view;
  view.attach(target.window());
  view.setResult(result);
  view.setElementsVisible(elements);
  if (time && !result->frames.empty()) {
    const auto later = [&](const auto& a, const auto& b) {
      return std::abs(a->time - *time) < std::abs(b->time - *time);
    };
    const auto nearest = std::min_element(result->frames.begin(), result->frames.end(), later);
    view.setFrame(static_cast<int>(nearest - result->frames.begin()));
  }
  view.setTheme(options.theme);
  view.setCaption(options.caption);
  view.setAxisView(options.view);
  Image image;
  target.render(image);
  return image;
}

}  // namespace pliant::render
