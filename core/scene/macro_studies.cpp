#include "core/scene/macro_studies.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/macro_placement.hpp"
#include "core/scene/macro_study.hpp"
#include "core/scene/native_patch.hpp"

namespace pliant::scene {

namespace {

using base::TerminationType;
using Eigen::Vector3d;

class MacroEquilibriumStudy final : public MacroStudy {
 public:
  using MacroStudy::MacroStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    checkNative();
    interlock::MacroSheet sheet;
    const std::shared_ptr<MacroResult> result = begin(sheet, context);
    if (context.cancelRequested()) {
      judgeNothing(*result);
      finish(*result, TerminationType::cancelled, "The study was cancelled.", watch);
      return result;
    }
    interlock::MacroOptions macroOptions;
    macroOptions.limits = options_["limits"] == "barrier" ? mechanics::StrainLimitFunction::Kind::barrier
                                                          : mechanics::StrainLimitFunction::Kind::penalty;
    macroOptions.margin = options_["margin"];
    macroOptions.penalty = options_["penalty"];
    if (options_["limits"] == "penalty") macroOptions.maximumIterations = 5000;
    if (options_["elements"]) macroOptions.pathSpacing = placementSpacing(*cell_);
    const interlock::MacroSimulation simulation =
        locate(place_, [&] { return interlock::MacroSimulation(sheet, macroOptions, builder_.contact()); });
    const interlock::MacroLoads loads = builder_.loads(sheet, &result->loaded);
    const interlock::Vector start = builder_.start(sheet);
    result->clamped = loads.clamped;
    const double settled = options_["elements"] ? (options_["native"] ? 0.9 : begun() + 0.1) : 1;
    std::vector<interlock::Vector> way{start};
    auto [termination, message] = load(simulation, loads, settled, way, *result, context, [&](MacroResult& part) {
      finish(part, TerminationType::converged, "", watch);
      if (observe) observe(std::make_shared<const MacroResult>(part));
    });
    if (options_["elements"] && termination == TerminationType::converged) {
      context.setRange(settled, 1);
      const PlacementOutcome outcome = placeElements(way, options_, place_, *result, context);
      termination = outcome.termination;
      message = outcome.message;
    }
    finish(*result, termination, message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }

 private:
  void checkNative() const {
    if (!options_["native"]) return;
    if (options_["shape"] == "mesh" || options_["shape"] == "outline" || options_["angle"] != 0.0 ||
        !options_["regions"].empty())
      throw base::InputError(place_, "A native patch is a disk, a hexagon or a rectangle along the material's axes.");
    if (!builder_.contact().bodies.empty() || options_["placement"] != Json(macroRestPlacement()))
      throw base::InputError(place_, "A native patch meets no bodies, and starts where its sheet rests.");
  }

  /// Lets the loads come, up to the progress `settled`; `way` gets where the sheet was, and `hand` what there is of the
  /// result between two steps.
  std::pair<TerminationType, std::string> load(const interlock::MacroSimulation& simulation,
                                               const interlock::MacroLoads& loads, double settled,
                                               std::vector<interlock::Vector>& way, MacroResult& result,
                                               base::ExecutionContext& context,
                                               const std::function<void(MacroResult&)>& hand) const {
    const geometry::SurfaceMesh& mesh = result.sheet->mesh;
    const interlock::Vector start = way.front();
    std::optional<NativePatch> native;
    if (options_["native"]) native.emplace(*cell_, options_, place_, equilibriumOptions());
    const int steps = options_["load_steps"];
    if (steps > 1) {
      judgeNothing(result);
      result.state.positions = start;
      if (native) result.native = native->comparison();
      addFrame(0, result);
    }
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      const double before = begun() + (settled - begun()) * (step - 1) / steps, length = (settled - begun()) / steps;
      const double between = native ? 0.7 : 1;  // of the step: the sheet, then the elements
      context.setRange(before, before + between * length);
      interlock::MacroLoads present = loads;
      present.force *= part;
      present.gravity *= part;
      const interlock::Vector from = way.back();
      result.state = locate(place_, [&] { return simulation.equilibrium(present, &from, context); });
      TerminationType termination = result.state.report.termination;
      std::string message = result.state.report.message;
      for (std::size_t i = 1; i < result.state.path.size(); ++i) way.push_back(result.state.path[i]);
      way.push_back(result.state.positions);
      result.state.path.clear();
      result.deflections = columns(result.state.positions - start)(Eigen::all, result.loaded);
      if (native && termination != TerminationType::cancelled) {
        context.setRange(before + between * length, before + length);
        native->load(part, mesh, result.state.positions, context);
        result.native = native->comparison();
        if (termination == TerminationType::converged) termination = result.native->rest.termination;
        if (message.empty()) message = result.native->rest.message;
      }
      if (steps > 1) {
        addFrame(part, result);
        result.state.work = workOf(simulation, present, result.state.positions - start);
        if (termination != TerminationType::converged)
          message = "At " + base::formatQuantity(100 * part, {}) + " % of the loads: " + message;
        else if (step < steps)
          hand(result);
      }
      if (termination != TerminationType::converged || step == steps) return {termination, message};
    }
    return {TerminationType::converged, ""};
  }

  static Eigen::Matrix3Xd columns(const interlock::Vector& coordinates) {
    return coordinates.reshaped(3, coordinates.size() / 3);
  }

  static void addFrame(double part, MacroResult& result) {
    auto frame = std::make_shared<MacroFrame>();
    frame->time = part;
    frame->positions = columns(result.state.positions);
    frame->bodyPoints = mechanics::bodyPointsAt(result.bodies, 0);
    frame->stretchGauge = result.state.stretchGauge;
    frame->bendingGauge = result.state.bendingGauge;
    if (result.native) {
      frame->native = result.native->rest.state;
      frame->nativeDistance = result.native->meanDistance;
    }
    result.frames.push_back(std::move(frame));
  }

  /// Of all loads along the way from rest [J].
  static double workOf(const interlock::MacroSimulation& simulation, const interlock::MacroLoads& loads,
                       const interlock::Vector& moved) {
    const Vector3d weighed = columns(moved) * simulation.masses();
    return loads.force.dot(moved) + loads.gravity.dot(weighed);
  }

  static Json macroRestPlacement() {
    return {{"position", {0.0, 0.0, 0.0}}, {"axis", {0.0, 0.0, 1.0}}, {"angle", 0.0}};
  }
};

}  // namespace

std::unique_ptr<Study> makeMacroEquilibriumStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                 const Json& options) {
  return std::make_unique<MacroEquilibriumStudy>(scene, options);
}

}  // namespace pliant::scene
