#include "core/scene/interlock_studies.hpp"

#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/interlock/boundary_file.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/sharded_study.hpp"

namespace pliant::scene {

using base::TerminationType;

namespace {

interlock::Lateral lateralNamed(const std::string& name) {
  if (name == "principal") return interlock::Lateral::principal;
  if (name == "biaxial") return interlock::Lateral::biaxial;
  return name == "held" ? interlock::Lateral::held : interlock::Lateral::free;
}

class InterlockStudy : public Study {
 public:
  /// The model, which a cell has no part in, is not used.
  InterlockStudy(const Scene& scene, const std::shared_ptr<const mechanics::Model>&, const Json& options)
      : cell_(std::make_shared<const interlock::UnitCell>(buildCell(scene, options["cell"]))),
        options_(options),
        directory_(scene.directory()),
        provenance_(provenanceOf(scene, options)) {}

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

 protected:
  interlock::EquilibriumOptions equilibriumOptions() const {
    interlock::EquilibriumOptions options;
    options.finalGap = options_["final_gap"];
    return options;
  }

  interlock::LimitOptions limitOptions() const {
    interlock::LimitOptions options;
    options.lateral = lateralNamed(options_["lateral"]);
    options.ratio = options_["ratio"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.trials = options_["trials"];
    return options;
  }

  template <class AnyResult>
  void finish(AnyResult& result, TerminationType termination, const std::string& message,
              const base::Stopwatch& watch) const {
    result.cell = cell_;
    result.provenance = provenance_;
    result.termination = termination;
    result.message = message;
    result.seconds = watch.seconds();
  }

  /// Termination and message of one limit: without any it is no result.
  static std::pair<TerminationType, std::string> outcomeOf(const interlock::DirectionLimit& limit) {
    if (limit.equilibrium.converged() && limit.equilibrium.kind == interlock::RestKind::unlimited)
      return {TerminationType::infeasible, "nothing limits this deformation"};
    return {limit.equilibrium.termination, limit.equilibrium.message};
  }

  std::shared_ptr<const interlock::UnitCell> cell_;
  Json options_;
  std::filesystem::path directory_;
  Provenance provenance_;
};

class CellTestStudy final : public InterlockStudy {
 public:
  using InterlockStudy::InterlockStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<CellTestResult>();
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    result->limit = interlock::directionLimit(
        solver, options_["direction"], options_["load"] == "compress", limitOptions(), &context);
    const auto [termination, message] = outcomeOf(result->limit);
    finish(*result, termination, message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }
};

class FreeTravelStudy final : public InterlockStudy {
 public:
  using InterlockStudy::InterlockStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<FreeTravelResult>();
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    std::vector<double> angles(options_["directions"].get<std::size_t>());
    for (std::size_t i = 0; i < angles.size(); ++i)
      angles[i] = std::numbers::pi * static_cast<double>(i) / static_cast<double>(angles.size());
    result->directions = interlock::freeTravel(solver, angles, limitOptions(), context);
    TerminationType termination = TerminationType::converged;
    std::string message;
    for (const interlock::FreeTravel& direction : result->directions)
      for (const auto* limit : {&direction.stretch, &direction.compression})
        if (const auto [each, sentence] = outcomeOf(*limit); termination == TerminationType::converged)
          termination = each, message = sentence;
    finish(*result, termination, message, watch);
    if (observe) observe(result);
    return result;
  }
};

class StretchGridStudy final : public InterlockStudy {
 public:
  using InterlockStudy::InterlockStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<StretchGridResult>();
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    interlock::LimitGridOptions options;
    options.directions = options_["directions"];
    options.steps = options_["steps"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    result->grid = interlock::computeLimitGrid(solver, options, context);
    finish(*result, result->grid.termination, result->grid.message, watch);
    if (observe) observe(result);
    return result;
  }
};

class StretchBoundaryStudy final : public InterlockStudy, public ShardedStudy {
 public:
  using InterlockStudy::InterlockStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    std::optional<interlock::BoundaryFile> memory;
    if (options_.contains("checkpoint")) memory.emplace(directory_ / options_["checkpoint"].get<std::string>(), key());
    auto result = resultOf(memory ? &*memory : nullptr, memory ? memory->recalledCount() : 0, watch, context);
    if (observe) observe(result);
    return result;
  }

  TerminationType runShard(const base::Shard& shard, const std::filesystem::path& file,
                           base::ExecutionContext& context) const override {
    interlock::BoundaryFile memory(file, key());
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    return interlock::computeRays(solver, boundaryOptions(), shard, context, memory);
  }
  const ShardedStudy* sharded() const override { return this; }

  std::shared_ptr<const Result> merge(const std::vector<std::filesystem::path>& files,
                                      base::ExecutionContext& context) const override {
    const base::Stopwatch watch;
    interlock::KnownStates known;
    for (const std::filesystem::path& file : files)
      if (!known.read(file, key()))
        throw base::InputError(
            file.string(), "This shard is not of the scene and study as they are now; run it again.");
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    if (const auto missing = interlock::missingRays(solver, boundaryOptions(), known); !missing.empty())
      throw base::InputError(files[static_cast<std::size_t>(missing.front()) % files.size()].string(),
                             "This shard is not finished: " + std::to_string(missing.size()) +
                                 " limits are missing in all shards together. Run it again; it goes on where it was.");
    return resultOf(&known, known.count(), watch, context);
  }

 private:
  interlock::BoundaryOptions boundaryOptions() const {
    interlock::BoundaryOptions options;
    options.subdivisions = options_["subdivisions"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.tolerance = options_["tolerance"];
    options.maximumStates = options_["maximum_states"];
    options.testStarShape = options_["test_star_shape"];
    options.useSymmetries = options_["use_symmetries"];
    return options;
  }

  /// What kept limits hold for.
  std::string key() const { return provenance_.version + " " + provenance_.sceneHash + " " + options_.dump(); }

  std::shared_ptr<const StretchBoundaryResult> resultOf(interlock::BoundaryMemory* memory, int recalled,
                                                        const base::Stopwatch& watch,
                                                        base::ExecutionContext& context) const {
    auto result = std::make_shared<StretchBoundaryResult>();
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    result->recalled = recalled;
    result->boundary = interlock::computeBoundary(solver, boundaryOptions(), context, memory);
    finish(*result, result->boundary.termination, result->boundary.message, watch);
    return result;
  }
};

}  // namespace

std::unique_ptr<Study> makeCellTestStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                         const Json& options) {
  return std::make_unique<CellTestStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeFreeTravelStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const Json& options) {
  return std::make_unique<FreeTravelStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeStretchBoundaryStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                const Json& options) {
  return std::make_unique<StretchBoundaryStudy>(scene, std::move(model), options);
}

std::unique_ptr<Study> makeStretchGridStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options) {
  return std::make_unique<StretchGridStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
