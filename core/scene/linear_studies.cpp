#include "core/scene/linear_studies.hpp"

#include "core/base/stopwatch.hpp"
#include "core/harmonic/linear_response.hpp"
#include "core/scene/modes_result.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

namespace {

/// Samples from which the steady part of loads and drives is taken.
constexpr int steadySamples = 64;

class LinearStudy : public Study {
 public:
  LinearStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : model_(std::move(model)), options_(options), provenance_(provenanceOf(scene, options)) {}

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

 protected:
  template <class AnyResult>
  void finish(AnyResult& result, const base::SolverReport& report, const base::Stopwatch& watch,
              base::ExecutionContext& context) const {
    result.provenance = provenance_;
    result.termination = report.termination;
    result.message = report.message;
    result.seconds = watch.seconds();
    context.reportProgress(1);
  }

  std::shared_ptr<const mechanics::Model> model_;
  Json options_;

 private:
  Provenance provenance_;
};

class LinearModesStudy final : public LinearStudy {
 public:
  using LinearStudy::LinearStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<ModesResult>();
    harmonic::HarmonicBalanceProblem problem(model_, math::HarmonicBasis(1, steadySamples));
    problem.setDriveFraction(0);
    harmonic::LinearModesOptions modes;
    modes.count = options_["count"];
    result->modes = harmonic::computeLinearModes(problem, modes, context);
    result->problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(std::move(problem));
    finish(*result, result->modes.report, watch, context);
    if (observe) observe(result);
    return result;
  }
};

class LinearResponseStudy final : public LinearStudy {
 public:
  using LinearStudy::LinearStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<HarmonicResult>();
    result->isCurve = true;
    result->isLinear = true;
    result->problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(
        model_, math::HarmonicBasis(options_["harmonics"], options_["samples"]));
    harmonic::LinearResponseOptions response;
    response.from = options_["from"];
    response.to = options_["to"];
    response.points = options_["points"];
    response.locationTolerance = options_["location_tolerance"];
    harmonic::FrequencyResponse curve = harmonic::traceLinearResponse(*result->problem, response, context);
    for (harmonic::ResponsePoint& point : curve.points) result->points.push_back(std::move(point));
    finish(*result, curve.report, watch, context);
    result->report = std::move(curve.report);
    if (observe) observe(result);
    return result;
  }
};

}  // namespace

std::unique_ptr<Study> makeLinearModesStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options) {
  return std::make_unique<LinearModesStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeLinearResponseStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                               const Json& options) {
  return std::make_unique<LinearResponseStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
