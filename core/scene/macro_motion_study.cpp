#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/macro_placement.hpp"
#include "core/scene/macro_studies.hpp"
#include "core/scene/macro_study.hpp"

namespace pliant::scene {

namespace {

using base::TerminationType;

/// Between two snapshots for whoever watches [s].
constexpr double timeBetweenSnapshots = 0.2;

class MacroMotionStudy final : public MacroStudy {
 public:
  using MacroStudy::MacroStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    interlock::MacroSheet sheet;
    const std::shared_ptr<MacroResult> result = begin(sheet, context);
    if (context.cancelRequested()) {
      judgeNothing(*result);
      finish(*result, TerminationType::cancelled, "The study was cancelled.", watch);
      return result;
    }
    interlock::MacroLoads loads = builder_.loads(sheet);
    result->clamped = loads.clamped;
    std::vector<interlock::MacroGrip> grips = builder_.grips(sheet);
    interlock::MacroOptions macroOptions;
    macroOptions.margin = options_["margin"];
    interlock::MacroMotion motion = locate(place_, [&] {
      auto simulation = std::make_shared<const interlock::MacroSimulation>(sheet, macroOptions, builder_.contact());
      return interlock::MacroMotion(
          std::move(simulation), std::move(loads), std::move(grips), builder_.start(sheet), options());
    });
    motion.setVelocities(spaceOf(options_["velocity"]).replicate(sheet.mesh.points.cols(), 1));
    result->state = motion.judged();
    result->deflections.resize(3, 0);
    addFrame(motion, *result);
    const auto count = static_cast<long>(std::llround(options_["duration"].get<double>() / options().timeStep));
    const long every = options_["frame_every"];
    const bool withElements = options_["elements"];
    const double spacing = withElements ? placementSpacing(*cell_) : 0;
    std::vector<interlock::Vector> way{motion.positions()};
    context.setRange(begun(), withElements ? begun() + 0.5 * (1 - begun()) : 1);
    TerminationType termination = TerminationType::converged;
    std::string message;
    base::Stopwatch sinceSnapshot;
    for (long i = 1; i <= count && termination == TerminationType::converged; ++i) {
      result->state = motion.step(context);
      termination = result->state.report.termination;
      message = result->state.report.message;
      if (termination != TerminationType::converged) {
        message = "At " + base::formatQuantity(motion.time(), base::dimensions::time) + ": " + message;
        break;
      }
      addStep(motion, *result);
      if (withElements && farthest(motion.positions(), way.back()) >= spacing) way.push_back(motion.positions());
      if (i % every == 0 || i == count) addFrame(motion, *result);
      context.reportProgress(static_cast<double>(i) / static_cast<double>(count));
      if (observe && sinceSnapshot.seconds() > timeBetweenSnapshots) {
        finish(*result, termination, message, watch);
        observe(std::make_shared<const MacroResult>(*result));
        sinceSnapshot = base::Stopwatch();
      }
    }
    if (withElements && termination == TerminationType::converged) {
      context.setRange(begun() + 0.5 * (1 - begun()), 1);
      if (way.back() != motion.positions()) way.push_back(motion.positions());
      const PlacementOutcome outcome = placeElements(way, options_, place_, *result, context);
      termination = outcome.termination;
      message = outcome.message;
    }
    finish(*result, termination, message, watch);
    if (observe) observe(result);
    return result;
  }

 private:
  /// How far the farthest node is from where it was [m].
  static double farthest(const interlock::Vector& positions, const interlock::Vector& before) {
    return (positions - before).reshaped(3, before.size() / 3).colwise().norm().maxCoeff();
  }

  interlock::MacroMotionOptions options() const {
    interlock::MacroMotionOptions options;
    options.timeStep = options_["time_step"];
    options.damping = options_["damping"];
    options.barrier = options_["barrier"];
    return options;
  }

  static void addFrame(const interlock::MacroMotion& motion, MacroResult& result) {
    auto frame = std::make_shared<MacroFrame>();
    frame->time = motion.time();
    frame->positions = motion.positions().reshaped(3, motion.positions().size() / 3);
    frame->bodyPoints = motion.bodyPoints();
    frame->stretchGauge = result.state.stretchGauge;
    frame->bendingGauge = result.state.bendingGauge;
    result.frames.push_back(std::move(frame));
  }

  static void addStep(const interlock::MacroMotion& motion, MacroResult& result) {
    MacroStepRecord& record = result.steps.emplace_back();
    record.time = motion.time();
    record.energies = motion.energies();
    record.stretchGauge = result.state.stretchGauge.maxCoeff();
    record.bendingGauge = result.state.bendingGauge.maxCoeff();
    record.smallestGap = result.state.smallestGap;
    record.gripLag = motion.gripLag();
    record.bodyLag = motion.bodyLag();
    record.friction = result.state.friction;
    record.residual = result.state.report.residual();
    record.iterations = static_cast<int>(result.state.report.iterations.size()) - 1;
  }
};

}  // namespace

std::unique_ptr<Study> makeMacroMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                            const Json& options) {
  return std::make_unique<MacroMotionStudy>(scene, options);
}

}  // namespace pliant::scene
