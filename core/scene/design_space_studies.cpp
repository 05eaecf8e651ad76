#include "core/scene/design_space_studies.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/scene/design_space_result.hpp"
#include "core/scene/harmonic_studies.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/study_input.hpp"

namespace pliant::scene {

namespace {

DesignMeasure measureOf(const mechanics::Model& model, const Json& entry) {
  DesignMeasure measure;
  measure.largestIsBest = entry["goal"] == "largest";
  if (entry["type"] == "total_mass") {
    measure.kind = DesignMeasure::Kind::totalMass;
    return measure;
  }
  if (entry["type"] == "displacement") measure.kind = DesignMeasure::Kind::displacement;
  while (model.probes[measure.probe].name != entry["probe"]) ++measure.probe;
  return measure;
}

class DesignSpaceStudy final : public Study {
 public:
  DesignSpaceStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : model_(std::move(model)), options_(options), provenance_(provenanceOf(scene, options)) {
    requireModestSize(scene, model_, name(), "harmonics", options["harmonics"]);
    const std::string place = placeOfStudy(scene, options);
    if (options.contains("parameters")) {
      for (std::size_t i = 0; i < options["parameters"].size(); ++i)
        parameters_.push_back(parameterNamed(*model_, options["parameters"], i, place + "/parameters"));
    } else {
      parameters_.resize(model_->parameters.size());
      std::iota(parameters_.begin(), parameters_.end(), 0);
    }
    if (parameters_.empty()) throw base::InputError(place, "The scene has no parameters that could change.");
  }

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<DesignSpaceResult>();
    result->provenance = provenance_;
    result->model = model_;
    result->parameters = parameters_;
    result->omega = options_["frequency"];
    result->harmonics = options_["harmonics"];
    result->samples = options_["samples"];
    for (std::size_t i = 0; i < 2; ++i) result->measures[i] = measureOf(*model_, options_["measures"][i]);
    harmonic::DesignSpaceOptions space;
    space.omega = result->omega;
    space.parameters = parameters_;
    space.count = options_["count"];
    space.seed = options_["seed"];
    space.motion.tolerance = options_["tolerance"];
    space.motion.maximumIterations = options_["maximum_iterations"];
    space.motion.maximumRampSteps = options_["maximum_ramp_steps"];
    space.motion.startScale = options_["start_scale"];
    const harmonic::HarmonicBalanceProblem problem(model_, math::HarmonicBasis(result->harmonics, result->samples));
    result->space = harmonic::sampleDesignSpace(problem, space, context);
    result->termination = result->space.report.termination;
    result->message = result->space.report.message;
    result->seconds = watch.seconds();
    if (observe) observe(result);
    return result;
  }

 private:
  std::shared_ptr<const mechanics::Model> model_;
  Json options_;
  Provenance provenance_;
  std::vector<int> parameters_;
};

}  // namespace

std::unique_ptr<Study> makeDesignSpaceStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options) {
  return std::make_unique<DesignSpaceStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
