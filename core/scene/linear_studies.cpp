#include "core/scene/linear_studies.hpp"

#include "core/base/stopwatch.hpp"
#include "core/scene/modes_result.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

namespace {

/// Samples from which the steady part of loads and drives is taken.
constexpr int steadySamples = 64;

class LinearModesStudy final : public Study {
 public:
  LinearModesStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : model_(std::move(model)), options_(options), provenance_(provenanceOf(scene, options)) {}

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<ModesResult>();
    harmonic::HarmonicBalanceProblem problem(model_, math::HarmonicBasis(1, steadySamples));
    problem.setDriveFraction(0);
    harmonic::LinearModesOptions modes;
    modes.count = options_["count"];
    result->modes = harmonic::computeLinearModes(problem, modes, context);
    result->problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(std::move(problem));
    result->provenance = provenance_;
    result->termination = result->modes.report.termination;
    result->message = result->modes.report.message;
    result->seconds = watch.seconds();
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }

 private:
  std::shared_ptr<const mechanics::Model> model_;
  Json options_;
  Provenance provenance_;
};

}  // namespace

std::unique_ptr<Study> makeLinearModesStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options) {
  return std::make_unique<LinearModesStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
