#include "core/scene/bending_studies.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/interlock/bending_boundary.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/bending_result.hpp"
#include "core/scene/boundary_shards.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_study.hpp"
#include "core/scene/sharded_study.hpp"

namespace pliant::scene {

using base::TerminationType;
using interlock::BendingLimit;

namespace {

/// Place of a study in its scene.
std::string pointerOfStudy(const Scene& scene, const Json& options) {
  const Json& studies = scene.normalized()["studies"];
  std::size_t index = 0;
  while (studies[index]["name"] != options["name"]) ++index;
  return "/studies/" + std::to_string(index);
}

class PatchStudy : public InterlockStudy {
 public:
  PatchStudy(const Scene& scene, const Json& options)
      : InterlockStudy(scene, options), place_(scene.name() + ": " + pointerOfStudy(scene, options)) {}

 protected:
  std::shared_ptr<const interlock::UnitCell> cut(const interlock::PatchOutline& outline) const {
    return locate(
        place_, [&] { return std::make_shared<const interlock::UnitCell>(interlock::cutPatch(*cell_, outline)); });
  }

  interlock::PatchOutline outline() const {
    interlock::PatchOutline outline;
    outline.centre = {options_["centre"][0].get<double>(), options_["centre"][1].get<double>()};
    if (options_.contains("radius") == options_.contains("size"))
      throw base::InputError(place_, "Either \"radius\" or \"size\" tells which elements belong to the patch.");
    if (options_.contains("radius")) {
      outline.radius = options_["radius"];
    } else {
      outline.kind = interlock::PatchOutline::Kind::rectangle;
      outline.size = {options_["size"][0].get<double>(), options_["size"][1].get<double>()};
    }
    return outline;
  }

  interlock::EquilibriumOptions equilibriumOptions() const {
    interlock::EquilibriumOptions options = InterlockStudy::equilibriumOptions();
    options.looseTolerance = 1;
    options.maximumIterations = 2000;
    return options;
  }

  interlock::BendingOptions bendingOptions() const {
    interlock::BendingOptions options;
    if (options_.contains("lateral")) options.lateral = lateral();
    options.increment = options_["increment"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.trials = options_["trials"];
    return options;
  }

  /// A fold is an answer too: that there is no limit. Only where contact did not settle the study has failed.
  void finishLimits(InterlockResult& result, const std::vector<const BendingLimit*>& limits,
                    const base::Stopwatch& watch) const {
    for (const BendingLimit* limit : limits)
      if (!limit->equilibrium.converged())
        return finish(result, limit->equilibrium.termination, limit->equilibrium.message, watch);
    finish(result, TerminationType::converged, "", watch);
  }

  std::string place_;
};

class BendingTestStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<BendingTestResult>();
    result->patch = cut(outline());
    const interlock::PatchSolver solver(*result->patch, equilibriumOptions());
    result->limit = bendingLimit(solver, options_["direction"], options_["bend"] == "down", bendingOptions(), &context);
    finishLimits(*result, {&result->limit}, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }
};

class CurvatureLimitsStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<CurvatureLimitsResult>();
    result->patch = cut(outline());
    const interlock::PatchSolver solver(*result->patch, equilibriumOptions());
    std::vector<double> angles(options_["directions"].get<std::size_t>());
    for (std::size_t i = 0; i < angles.size(); ++i)
      angles[i] = std::numbers::pi * static_cast<double>(i) / static_cast<double>(angles.size());
    result->directions = bendingLimits(solver, angles, bendingOptions(), context);
    std::vector<const BendingLimit*> limits;
    for (const interlock::BendingLimits& direction : result->directions)
      limits.insert(limits.end(), {&direction.up, &direction.down});
    finishLimits(*result, limits, watch);
    if (observe) observe(result);
    return result;
  }
};

class BendingSizeStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<BendingSizeResult>();
    std::vector<std::unique_ptr<interlock::PatchSolver>> solvers;
    for (const Json& radius : options_["radii"]) {
      interlock::PatchOutline outline;
      outline.centre = {options_["centre"][0].get<double>(), options_["centre"][1].get<double>()};
      outline.radius = radius;
      result->patch = cut(outline);
      solvers.push_back(std::make_unique<interlock::PatchSolver>(*result->patch, equilibriumOptions()));
      result->sizes.push_back({outline.radius, static_cast<int>(result->patch->elements.size()), {}});
    }
    constexpr int tests = static_cast<int>(BendingSizeResult::names.size());
    const int count = tests * static_cast<int>(solvers.size());
    std::atomic<int> done{0};
    // The largest first, since they take longest.
    math::parallelFor(count, [&](int k) {
      const int i = static_cast<int>(solvers.size()) - 1 - k / tests, test = k % tests;
      result->sizes[i].limits[test] = limitOf(*solvers[i], test, context);
      context.reportProgress(static_cast<double>(++done) / count);
    });
    std::vector<const BendingLimit*> limits;
    for (const BendingSizeResult::Size& size : result->sizes)
      for (const BendingLimit& limit : size.limits) limits.push_back(&limit);
    finishLimits(*result, limits, watch);
    if (observe) observe(result);
    return result;
  }

 private:
  /// In the order of BendingSizeResult::names.
  BendingLimit limitOf(const interlock::PatchSolver& solver, int test, const base::ExecutionContext& context) const {
    const double angle = options_["direction"];
    const interlock::BendingOptions bending = bendingOptions();
    if (test == 0) return bendingLimit(solver, angle, false, bending, &context);
    const double sign = test % 2 == 1 ? 1 : -1;
    const Eigen::Vector3d ray = test <= 2 ? Eigen::Vector3d(sign, 0, 0)
                                          : Eigen::Vector3d(0, sign * std::cos(2 * angle), sign * std::sin(2 * angle));
    const interlock::CellState start = solver.relaxed(interlock::restState(solver.patch()));
    return judged(solver, angle, farthestBend(solver, start, interlock::rayDrive(ray), bending, &context));
  }
};

class BendingBoundaryStudy final : public PatchStudy, public ShardedStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    std::optional<interlock::BoundaryFile> file;
    if (options_.contains("checkpoint")) file.emplace(directory_ / options_["checkpoint"].get<std::string>(), key());
    auto result = resultOf(file ? &*file : nullptr, file ? file->recalledCount() : 0, context);
    if (observe) observe(result);
    return result;
  }

  const ShardedStudy* sharded() const override { return this; }
  TerminationType runShard(const base::Shard& shard, const std::filesystem::path& file,
                           base::ExecutionContext& context) const override {
    const auto patch = cut(outline());
    const interlock::PatchSolver solver(*patch, equilibriumOptions());
    return runBoundaryShard(
        interlock::BentPatch(solver, bendingOptions()), boundaryOptions(), key(), shard, file, context);
  }
  std::shared_ptr<const Result> merge(const std::vector<std::filesystem::path>& files,
                                      base::ExecutionContext& context) const override {
    const auto patch = cut(outline());
    const interlock::PatchSolver solver(*patch, equilibriumOptions());
    interlock::KnownStates known;
    readBoundaryShards(interlock::BentPatch(solver, bendingOptions()), boundaryOptions(), key(), files, known);
    return resultOf(&known, known.count(), context);
  }

 private:
  interlock::BoundaryOptions boundaryOptions() const {
    interlock::BoundaryOptions options;
    options.subdivisions = options_["subdivisions"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.testStarShape = options_["test_star_shape"];
    return options;
  }

  std::shared_ptr<const BendingBoundaryResult> resultOf(interlock::BoundaryMemory* memory, int recalled,
                                                        base::ExecutionContext& context) const {
    const base::Stopwatch watch;
    auto result = std::make_shared<BendingBoundaryResult>();
    result->patch = cut(outline());
    const interlock::PatchSolver solver(*result->patch, equilibriumOptions());
    result->recalled = recalled;
    result->boundary =
        interlock::computeBoundary(interlock::BentPatch(solver, bendingOptions()), boundaryOptions(), context, memory);
    finish(*result, result->boundary.termination, result->boundary.message, watch);
    return result;
  }
};

class GravityBendingStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<GravityBendingResult>();
    result->patch = cut(outline());
    result->direction = options_["direction"];
    const interlock::PatchSolver solver(*result->patch, equilibriumOptions());
    const Eigen::Vector2d along(std::cos(result->direction), std::sin(result->direction));
    double first = std::numeric_limits<double>::infinity();
    for (const auto& element : result->patch->elements) first = std::min(first, along.dot(element.position.head<2>()));
    const double width = options_["clamped_width"];
    std::vector<bool> held;
    for (const auto& element : result->patch->elements) {
      held.push_back(along.dot(element.position.head<2>()) <= first + width);
      if (held.back()) result->clamped.push_back(static_cast<int>(held.size()) - 1);
    }
    Eigen::Vector3d gravity;
    for (int i = 0; i < 3; ++i) gravity[i] = options_["gravity"][i];
    interlock::PatchLoads loads;
    loads.forces = weightsOf(*result->patch, options_["density"], gravity);
    loads.clamped = result->clamped;
    for (const interlock::PointLoad& load : loads.forces) result->weight += load.force.norm();
    const interlock::CellState start = interlock::restState(*result->patch);
    const double perturbation = options_["perturbation"];
    result->rest =
        solver.solve(perturbation > 0 ? perturbedBeyond(solver, start, perturbation, held) : start, loads, &context);
    for (const interlock::CellContactForce& contact : result->rest.contacts)
      if (held[contact.pair.a] != held[contact.pair.b])
        result->reaction += (held[contact.pair.a] ? 1 : -1) * contact.force * contact.normal;
    if (result->rest.converged() && result->rest.kind == interlock::RestKind::unlimited)
      finish(*result, TerminationType::infeasible, "nothing holds the patch", watch);
    else
      finish(*result, result->rest.termination, result->rest.message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }

 private:
  /// Clamped elements stay where they are.
  interlock::CellState perturbedBeyond(const interlock::PatchSolver& solver, const interlock::CellState& start,
                                       double amplitude, const std::vector<bool>& held) const {
    return interlock::perturbedState(solver.contact(), start, solver.radius(), amplitude, options_["seed"],
                                     [&](Eigen::VectorXd velocity, double step) {
                                       for (std::size_t i = 0; i < held.size(); ++i)
                                         if (held[i]) velocity.segment<6>(6 * static_cast<Eigen::Index>(i)).setZero();
                                       return interlock::moved(start, velocity, step);
                                     });
  }
};

}  // namespace

std::unique_ptr<Study> makeBendingStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                        const Json& options) {
  const std::string type = options["type"];
  if (type == "bending_test") return std::make_unique<BendingTestStudy>(scene, options);
  if (type == "curvature_limits") return std::make_unique<CurvatureLimitsStudy>(scene, options);
  if (type == "bending_size") return std::make_unique<BendingSizeStudy>(scene, options);
  if (type == "bending_boundary") return std::make_unique<BendingBoundaryStudy>(scene, options);
  return std::make_unique<GravityBendingStudy>(scene, options);
}

}  // namespace pliant::scene
