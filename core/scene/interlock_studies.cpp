#include "core/scene/interlock_studies.hpp"

#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/boundary_study.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/interlock_study.hpp"

namespace pliant::scene {

using base::TerminationType;

namespace {

/// A study of limits of a cell.
class LimitStudy : public InterlockStudy {
 public:
  using InterlockStudy::InterlockStudy;

 protected:
  interlock::LimitOptions limitOptions() const {
    interlock::LimitOptions options;
    options.lateral = lateral();
    options.ratio = options_["ratio"];
    options.perturbation = options_["perturbation"];
    options.seed = options_["seed"];
    options.trials = options_["trials"];
    return options;
  }

  /// Termination and message of one limit: without any it is no result.
  static std::pair<TerminationType, std::string> outcomeOf(const interlock::DirectionLimit& limit) {
    if (limit.equilibrium.converged() && limit.equilibrium.kind == interlock::RestKind::unlimited)
      return {TerminationType::infeasible, "nothing limits this deformation"};
    return {limit.equilibrium.termination, limit.equilibrium.message};
  }
};

class CellTestStudy final : public LimitStudy {
 public:
  using LimitStudy::LimitStudy;

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

class FreeTravelStudy final : public LimitStudy {
 public:
  using LimitStudy::LimitStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    std::vector<double> angles(options_["directions"].get<std::size_t>());
    for (std::size_t i = 0; i < angles.size(); ++i)
      angles[i] = std::numbers::pi * static_cast<double>(i) / static_cast<double>(angles.size());
    const auto resultWith = [&](std::vector<interlock::FreeTravel> directions) {
      auto result = std::make_shared<FreeTravelResult>();
      result->directions = std::move(directions);
      TerminationType termination = TerminationType::converged;
      std::string message;
      for (const interlock::FreeTravel& direction : result->directions)
        for (const auto* limit : {&direction.stretch, &direction.compression})
          if (const auto [each, sentence] = outcomeOf(*limit); termination == TerminationType::converged)
            termination = each, message = sentence;
      finish(*result, termination, message, watch);
      return result;
    };
    base::GrowingResults<interlock::FreeTravel>::Observer observeLimits;
    if (observe) observeLimits = [&](const auto& soFar) { observe(resultWith(soFar)); };
    auto result = resultWith(interlock::freeTravel(solver, angles, limitOptions(), context, observeLimits));
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

class StretchBoundaryStudy final : public BoundaryStudy<InterlockStudy, StretchBoundaryResult> {
 public:
  using BoundaryStudy::BoundaryStudy;

 private:
  void withSubject(StretchBoundaryResult&, const Use& use) const override {
    const interlock::CellSolver solver(*cell_, equilibriumOptions());
    use(interlock::StretchedCell(solver));
  }

  interlock::BoundaryOptions boundaryOptions() const override {
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
};

}  // namespace

std::unique_ptr<Study> makeCellTestStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                         const Json& options) {
  return std::make_unique<CellTestStudy>(scene, options);
}

std::unique_ptr<Study> makeFreeTravelStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                           const Json& options) {
  return std::make_unique<FreeTravelStudy>(scene, options);
}

std::unique_ptr<Study> makeStretchBoundaryStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                const Json& options) {
  return std::make_unique<StretchBoundaryStudy>(scene, options);
}

std::unique_ptr<Study> makeStretchGridStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                            const Json& options) {
  return std::make_unique<StretchGridStudy>(scene, options);
}

}  // namespace pliant::scene
