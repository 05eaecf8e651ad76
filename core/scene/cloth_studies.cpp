#include "core/scene/cloth_studies.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/cloth/cloth_drape.hpp"
#include "core/scene/candidate_file.hpp"
#include "core/scene/cloth_builder.hpp"
#include "core/scene/cloth_recording.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/run_information.hpp"

namespace pliant::scene {

using base::TerminationType;

namespace {

cloth::ProjectionOptions projectionOptions(const Json& options) {
  cloth::ProjectionOptions projection;
  projection.cone.relativeGap = options["relative_gap"];
  projection.violation = options["violation"];
  projection.sweeps = options["maximum_sweeps"];
  return projection;
}

cloth::ProjectionNorm normOf(const Json& options) {
  return options["norm"] == "mass" ? cloth::ProjectionNorm::mass : cloth::ProjectionNorm::identity;
}

cloth::SteppingScheme schemeNamed(const std::string& name) {
  using enum cloth::SteppingScheme;
  if (name == "implicit_euler") return implicitEuler;
  if (name == "bdf2") return bdf2;
  if (name == "step_and_project") return stepAndProject;
  if (name == "bdf2_and_project") return bdf2AndProject;
  if (name == "bdf2_and_reflect") return bdf2AndReflect;
  return name == "second_order_reflect" ? secondOrderReflect : stepAndReflect;
}

cloth::SteppingOptions steppingOptions(const Json& options) {
  cloth::SteppingOptions stepping;
  stepping.scheme = schemeNamed(options["scheme"]);
  stepping.timeStep = options["time_step"];
  stepping.limitMethod = options["limit_method"];
  stepping.norm = normOf(options);
  stepping.projection = projectionOptions(options);
  stepping.newton.tolerance = options["newton_tolerance"];
  return stepping;
}

class ClothStudy : public Study {
 public:
  ClothStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : problem_(buildClothProblem(scene, std::move(model))),
        options_(options),
        provenance_(provenanceOf(scene, options)) {}

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

 protected:
  /// Calls `build`, whose errors without a location belong to the study.
  template <class Build>
  void check(const Scene& scene, const Build& build) const {
    const auto names = studyNames(scene);
    const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name()) - names.begin());
    locate(scene.name() + ": " + childPointer("/studies", index), build);
  }

  std::shared_ptr<const cloth::ClothProblem> problem_;
  Json options_;
  Provenance provenance_;
};

class ClothMotionStudy final : public ClothStudy {
 public:
  ClothMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : ClothStudy(scene, std::move(model), options) {
    check(scene, [&] { cloth::ClothSimulation(problem_, steppingOptions(options_)); });
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    ClothRecording growing(problem_, provenance_, observe);
    cloth::ClothSimulation simulation(problem_, steppingOptions(options_));
    growing.addFrame(0, simulation.state().positions, 0, nullptr);
    const double timeStep = options_["time_step"];
    const auto count = static_cast<long>(std::llround(options_["duration"].get<double>() / timeStep));
    const long every = options_["frame_every"];
    for (long i = 1; i <= count; ++i) {
      if (context.cancelRequested()) return growing.finish(TerminationType::cancelled, "The motion was cancelled.");
      const cloth::StepRecord record = simulation.step(context);
      if (!record.done())
        return growing.finish(
            record.termination,
            "At " + base::formatQuantity(simulation.state().time, base::dimensions::time) + ": " + record.message);
      growing.addStep(record, record.time, 0);
      if (i % every == 0 || i == count)
        growing.addFrame(record.time, simulation.state().positions, record.time, record.projection.get());
      growing.observe();
      context.reportProgress(static_cast<double>(i) / static_cast<double>(count));
    }
    return growing.finish(TerminationType::converged, "");
  }
};

class ClothDrapeStudy final : public ClothStudy {
 public:
  ClothDrapeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : ClothStudy(scene, std::move(model), options) {
    check(scene, [&] { cloth::ClothDrape(problem_, drapeOptions()); });
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    ClothRecording growing(problem_, provenance_, observe);
    const cloth::DrapeOptions drapeBy = drapeOptions();
    cloth::ClothDrape drape(problem_, drapeBy);
    growing.addFrame(0, drape.positions(), drapeBy.time, nullptr);
    const int most = options_["maximum_steps"], every = options_["frame_every"];
    double first = 0;
    for (int i = 1; i <= most; ++i) {
      if (context.cancelRequested()) return growing.finish(TerminationType::cancelled, "The drape was cancelled.");
      const cloth::DrapeRecord record = drape.step(context);
      if (!record.step.done()) return growing.finish(record.step.termination, record.step.message);
      growing.addStep(record.step, i, record.residual);
      if (i % every == 0 || drape.converged() || i == most)
        growing.addFrame(i, drape.positions(), drapeBy.time, record.step.projection.get());
      growing.observe();
      if (drape.converged()) {
        context.reportProgress(1);
        return growing.finish(TerminationType::converged, "");
      }
      first = std::max(first, record.residual);
      context.reportProgress(std::log(first / record.residual) / std::log(first / drapeBy.tolerance));
    }
    return growing.finish(TerminationType::iterationLimit,
                          "The forces do not balance within " + std::to_string(most) + " steps: what is left is " +
                              base::formatQuantity(growing.result().steps.back().residual, {}) +
                              " of the external force.");
  }

 private:
  cloth::DrapeOptions drapeOptions() const {
    cloth::DrapeOptions drape;
    drape.tolerance = options_["tolerance"];
    drape.timeStep = options_["time_step"];
    drape.time = options_["time"];
    drape.limitMethod = options_["limit_method"];
    drape.projection = projectionOptions(options_);
    drape.newton.tolerance = options_["newton_tolerance"];
    return drape;
  }
};

class ProjectionStudy final : public ClothStudy {
 public:
  ProjectionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : ClothStudy(scene, std::move(model), options) {
    check(scene, [&] {
      candidate_ = readCandidate(scene.directory() / std::filesystem::path(options["candidate"].get<std::string>()),
                                 problem_->sheet.nodeCount);
      if (!hasLimits(problem_->sheet)) throw base::InputError("", "a projection needs \"stretch_limits\" in the scene");
    });
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    ClothRecording growing(problem_, provenance_, observe);
    const cloth::SheetCones cones = cloth::sheetCones(problem_->sheet, normOf(options_));
    const auto limiter = cloth::makeStrainLimiter(
        options_["limit_method"].get<std::string>(), cones.constraints, projectionOptions(options_));
    // Where no triangle is stretched, whatever the candidate is like.
    const Eigen::Matrix3Xd rest = problem_->model->restPositions.reshaped(3, problem_->sheet.nodeCount);
    const base::Stopwatch watch;
    auto solution = std::make_shared<solvers::ConeSolution>(limiter->project(candidate_, rest, context));
    solution->report.seconds = watch.seconds();
    // Elements are counted among the limited triangles.
    for (int& element : solution->conflictingElements) element = cones.triangles[static_cast<std::size_t>(element)];
    ClothResult& result = growing.result();
    result.projection = solution;
    result.lastProjection = solution->report;
    growing.addFrame(0, candidate_, 0, nullptr);
    if (solution->positions.allFinite() && solution->positions.cols() == candidate_.cols())
      growing.addFrame(1, solution->positions, 0, solution.get());
    context.reportProgress(1);
    return growing.finish(solution->report.termination, solution->report.message);
  }

 private:
  Eigen::Matrix3Xd candidate_;
};

}  // namespace

ClothMotionSetup clothMotionSetup(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                  const std::string& study) {
  for (const Json& options : scene.normalized()["studies"])
    if (options["name"] == study && options["type"] == "cloth_motion") {
      auto problem = buildClothProblem(scene, std::move(model));
      return {std::move(problem), steppingOptions(options), provenanceOf(scene, options)};
    }
  throw base::InputError(scene.name(), "There is no study of the type cloth_motion named " + quote(study) + ".");
}

std::unique_ptr<Study> makeClothMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options) {
  return std::make_unique<ClothMotionStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeClothDrapeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options) {
  return std::make_unique<ClothDrapeStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeProjectionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options) {
  return std::make_unique<ProjectionStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
