#include "core/scene/time_studies.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/scene/harmonic_studies.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/time_results.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

/// Samples of the loads and drives, and harmonics of what an integration from rest needs no harmonics for.
constexpr int samplesOfRest = 64;
/// Periods from which the next start is extrapolated.
constexpr int extrapolationDepth = 10;

class TimeStudy : public Study {
 public:
  TimeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : model_(std::move(model)), options_(options), provenance_(provenanceOf(scene, options)) {}

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

 protected:
  harmonic::TimeIntegrationOptions integrationOptions() const {
    harmonic::TimeIntegrationOptions integration;
    integration.maximumPeriods = options_["maximum_periods"];
    integration.tolerance = options_["tolerance"];
    return integration;
  }

  /// Where the study is in its scene.
  std::string pointerTo(const Scene& scene) const {
    const auto names = studyNames(scene);
    const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name()) - names.begin());
    return scene.name() + ": " + childPointer("/studies", index);
  }

  void finish(Result& result, const base::SolverReport& report, const base::Stopwatch& watch) const {
    result.provenance = provenance_;
    result.termination = report.termination;
    result.message = report.message;
    result.seconds = watch.seconds();
  }

  std::shared_ptr<const mechanics::Model> model_;
  Json options_;

 private:
  Provenance provenance_;
};

class TimeIntegrationStudy final : public TimeStudy {
 public:
  TimeIntegrationStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : TimeStudy(scene, std::move(model), options) {
    const int coordinates = model_->dofs.freeCount();
    if (!options["shooting"].get<bool>() || coordinates <= harmonic::mostShootingCoordinates) return;
    throw InputError(pointerTo(scene) + "/shooting",
                     "Shooting is for models of at most " + std::to_string(harmonic::mostShootingCoordinates) +
                         " free coordinates; this one has " + std::to_string(coordinates) + ".");
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<TimeResult>();
    result->model = model_;
    harmonic::TimeIntegrationOptions integration = integrationOptions();
    integration.stepsPerPeriod = options_["steps_per_period"];
    integration.shooting = options_["shooting"];
    integration.acceleration = options_["extrapolate"].get<bool>() ? extrapolationDepth : 0;
    const harmonic::HarmonicBalanceProblem problem(model_, math::HarmonicBasis(1, samplesOfRest));
    result->integration = harmonic::integrateToPeriodicity(problem, options_["frequency"], integration, context);
    finish(*result, result->integration.report, watch);
    if (observe) observe(result);
    return result;
  }
};

class ComparisonStudy final : public TimeStudy {
 public:
  ComparisonStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : TimeStudy(scene, std::move(model), options) {
    const auto refuse = [&](const char* key, const char* sentence) {
      throw InputError(pointerTo(scene) + "/" + key, sentence);
    };
    requireModestSize(scene, model_, name(), "harmonic_counts", options["harmonic_counts"].back());
    for (const char* key : {"harmonic_counts", "steps_per_period"}) {
      const std::vector<int> numbers = options[key];
      if (!std::is_sorted(numbers.begin(), numbers.end(), std::less_equal<>()))
        refuse(key, "Expected numbers that ascend.");
    }
    for (const int steps : options["steps_per_period"])
      if (steps % options["steps_per_period"].front().get<int>() != 0)
        refuse("steps_per_period", "Expected multiples of the first number, so that there are common times.");
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<ComparisonResult>();
    result->omega = options_["frequency"];
    harmonic::MethodComparisonOptions comparison;
    comparison.harmonics = options_["harmonic_counts"].get<std::vector<int>>();
    comparison.samples = options_["samples"];
    comparison.steps = options_["steps_per_period"].get<std::vector<int>>();
    comparison.samplesHarmonics = options_["harmonics"];
    comparison.integration = integrationOptions();
    comparison.integration.acceleration = extrapolationDepth;
    result->comparison = harmonic::compareMethods(model_, result->omega, comparison, context);
    finish(*result, result->comparison.report, watch);
    if (observe) observe(result);
    return result;
  }
};

}  // namespace

std::unique_ptr<Study> makeTimeIntegrationStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                const Json& options) {
  return std::make_unique<TimeIntegrationStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeComparisonStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options) {
  return std::make_unique<ComparisonStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
