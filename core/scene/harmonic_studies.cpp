#include "core/scene/harmonic_studies.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/harmonic/backbone.hpp"
#include "core/harmonic/node_harmonics.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/second_frequency.hpp"
#include "core/scene/sensitivity_tables.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

/// Entries of ∂h/∂z beyond which factors no longer fit an ordinary machine.
constexpr double mostJacobianEntries = 2e8;

/// What the studies of harmonic balance share.
class HarmonicStudy : public Study {
 public:
  HarmonicStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : model_(std::move(model)), options_(options), provenance_(provenanceOf(scene, options)) {
    const char* key = options.contains("harmonics_tolerance") ? "maximum_harmonics" : "harmonics";
    requireModestSize(
        scene, model_, name(), key, options[key], hasSecondFrequency(options) ? options["samples"].get<int>() : 0);
  }

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

 protected:
  harmonic::HarmonicBalanceProblem makeProblem() const { return {model_, basisOf(options_)}; }

  harmonic::PeriodicMotionOptions newtonOptions() const {
    harmonic::PeriodicMotionOptions newton;
    newton.tolerance = options_["tolerance"];
    newton.maximumIterations = options_["maximum_iterations"];
    newton.maximumRampSteps = options_.value("maximum_ramp_steps", newton.maximumRampSteps);
    newton.startScale = options_.value("start_scale", newton.startScale);
    return newton;
  }

  bool wantsStability() const { return options_["stability"] == "on" && !hasSecondFrequency(options_); }

  std::shared_ptr<HarmonicResult> makeResult() const {
    auto result = std::make_shared<HarmonicResult>();
    result->provenance = provenance_;
    return result;
  }

  static void finish(HarmonicResult& result, base::SolverReport report, const base::Stopwatch& watch) {
    result.termination = report.termination;
    result.message = report.message;
    result.report = std::move(report);
    result.seconds = watch.seconds();
  }

  std::shared_ptr<const mechanics::Model> model_;
  Json options_;

 private:
  Provenance provenance_;
};

std::vector<harmonic::Amplitude> amplitudesOf(const harmonic::HarmonicBalanceProblem& problem,
                                              const mechanics::Vector& z) {
  std::vector<harmonic::Amplitude> amplitudes;
  for (const mechanics::Probe& probe : problem.model().probes)
    amplitudes.push_back(harmonic::amplitude(problem, z, probe.node));
  return amplitudes;
}

class PeriodicMotionStudy final : public HarmonicStudy {
 public:
  using HarmonicStudy::HarmonicStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    const double omega = options_["frequency"];
    auto result = makeResult();
    auto [problem, motion] = solve(omega, *result, context);
    result->problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(std::move(problem));
    if (motion.z.size() == result->problem->size() && motion.z.allFinite()) {
      harmonic::ResponsePoint point;
      point.omega = omega;
      point.drivePeriods = result->problem->drivePeriods();
      point.amplitudes = amplitudesOf(*result->problem, motion.z);
      point.residual = motion.report.residual();
      point.correction = motion.report.correction();
      point.newtonIterations = std::max(0, static_cast<int>(motion.report.iterations.size()) - 1);
      point.z = motion.z;
      if (wantsStability() && motion.report.converged())
        point.stability = harmonic::floquetStability(*result->problem, point.z, omega);
      result->points.push_back(std::move(point));
    }
    if (motion.report.converged())
      result->sensitivity = std::make_shared<const harmonic::ResponseSensitivity>(*result->problem, motion);
    finish(*result, std::move(motion.report), watch);
    if (observe) observe(result);
    return result;
  }

 private:
  std::pair<harmonic::HarmonicBalanceProblem, harmonic::PeriodicMotion> solve(double omega, HarmonicResult& result,
                                                                              base::ExecutionContext& context) const {
    harmonic::HarmonicBalanceProblem problem = makeProblem();
    if (!options_.contains("harmonics_tolerance")) {
      harmonic::PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, newtonOptions(), context);
      return {std::move(problem), std::move(motion)};
    }
    const double tolerance = options_["harmonics_tolerance"];
    const int most = options_["maximum_harmonics"];
    if (options_["harmonics_of"] == "model")
      return harmonic::solveWithAdaptiveHarmonics(std::move(problem), omega, tolerance, most, newtonOptions(), context);
    harmonic::NodeHarmonicsMotion found =
        harmonic::solveWithHarmonicsPerNode(std::move(problem), omega, tolerance, most, newtonOptions(), context);
    if (std::isfinite(found.leftOut)) result.leftOut = found.leftOut;
    return {std::move(found.problem), std::move(found.motion)};
  }
};

/// Studies whose result is a curve.
class CurveStudy : public HarmonicStudy {
 public:
  using HarmonicStudy::HarmonicStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    constexpr double secondsBetweenSnapshots = 0.05;
    const base::Stopwatch watch;
    base::Stopwatch sinceSnapshot;
    harmonic::HarmonicBalanceProblem problem = curveProblem();
    auto result = makeResult();
    result->isCurve = true;
    result->isBackbone = type() == "backbone";
    result->problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(problem);
    const auto onPoint = [&](const harmonic::ResponsePoint& point) {
      result->addProblemOf(point);
      result->points.push_back(point);
      if (!observe || sinceSnapshot.seconds() < secondsBetweenSnapshots) return;
      sinceSnapshot = {};
      auto snapshot = std::make_shared<HarmonicResult>(*result);
      snapshot->seconds = watch.seconds();
      observe(std::move(snapshot));
    };
    base::SolverReport report = trace(problem, context, onPoint);
    complete(*result, context);
    finish(*result, std::move(report), watch);
    if (observe) observe(result);
    return result;
  }

 protected:
  using PointCallback = std::function<void(const harmonic::ResponsePoint&)>;
  virtual harmonic::HarmonicBalanceProblem curveProblem() const = 0;
  virtual base::SolverReport trace(harmonic::HarmonicBalanceProblem& problem, base::ExecutionContext& context,
                                   const PointCallback& onPoint) const = 0;
  /// What is to be found out of the whole curve.
  virtual void complete(HarmonicResult&, base::ExecutionContext&) const {}
};

class FrequencyResponseStudy final : public CurveStudy {
 public:
  using CurveStudy::CurveStudy;

 protected:
  harmonic::HarmonicBalanceProblem curveProblem() const override { return makeProblem(); }
  base::SolverReport trace(harmonic::HarmonicBalanceProblem& problem, base::ExecutionContext& context,
                           const PointCallback& onPoint) const override {
    return harmonic::traceFrequencyResponse(problem, responseOptions(), context, onPoint).report;
  }
  void complete(HarmonicResult& result, base::ExecutionContext& context) const override {
    if (options_["peak_sensitivity"]) result.peakSensitivities = computePeakSensitivities(result, context);
  }

 private:
  harmonic::FrequencyResponseOptions responseOptions() const {
    harmonic::FrequencyResponseOptions response;
    response.from = options_["from"];
    response.to = options_["to"];
    response.initialStep = options_.value("initial_step", 0.0);
    response.minimumStep = options_.value("minimum_step", 0.0);
    response.maximumStep = options_.value("maximum_step", 0.0);
    response.maximumPoints = options_["maximum_points"];
    response.locationTolerance = options_["location_tolerance"];
    response.stability = wantsStability();
    response.branchDepth = options_["branches"];
    response.newton = newtonOptions();
    return response;
  }
};

class BackboneStudy final : public CurveStudy {
 public:
  using CurveStudy::CurveStudy;

 protected:
  harmonic::HarmonicBalanceProblem curveProblem() const override { return harmonic::freeProblem(makeProblem()); }
  base::SolverReport trace(harmonic::HarmonicBalanceProblem& problem, base::ExecutionContext& context,
                           const PointCallback& onPoint) const override {
    harmonic::BackboneOptions backbone;
    backbone.mode = options_["mode"];
    backbone.maximumAmplitude = options_["maximum_amplitude"];
    backbone.maximumPoints = options_["maximum_points"];
    backbone.newton = newtonOptions();
    return harmonic::traceBackbone(problem, backbone, context, onPoint).report;
  }
};

}  // namespace

void requireModestSize(const Scene& scene, const std::shared_ptr<const mechanics::Model>& model,
                       const std::string& study, const std::string& key, int harmonics, int samplesOfEach) {
  const mechanics::ElasticAssembler assembler(model);
  const bool twoFrequencies = samplesOfEach > 0;
  const double size = 2.0 * harmonics * (twoFrequencies ? harmonics + 1 : 1) + 1;
  const auto refuseBeyond = [&](double entries, const std::string& place, const std::string& what) {
    if (entries <= mostJacobianEntries) return;
    const auto names = studyNames(scene);
    const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), study) - names.begin());
    throw InputError(scene.name() + ": " + childPointer("/studies", index) + "/" + place,
                     what + " too many for a model with " + std::to_string(model->dofs.freeCount()) +
                         " free coordinates: the system would have " +
                         std::to_string(static_cast<long long>(entries / 1e6)) + " million entries, and " +
                         std::to_string(static_cast<long long>(mostJacobianEntries / 1e6)) + " are allowed.");
  };
  refuseBeyond(size * size * (2.0 * assembler.entryCount() + model->dofs.freeCount()), key,
               std::to_string(harmonics) + " harmonics are");
  if (twoFrequencies)
    refuseBeyond(static_cast<double>(samplesOfEach) * samplesOfEach * assembler.entryCount(), "samples",
                 std::to_string(samplesOfEach) + " times as many samples are");
}

std::unique_ptr<Study> makePeriodicMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                               const Json& options) {
  return std::make_unique<PeriodicMotionStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeFrequencyResponseStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                  const Json& options) {
  return std::make_unique<FrequencyResponseStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeBackboneStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                         const Json& options) {
  return std::make_unique<BackboneStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
