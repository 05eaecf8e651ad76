#include "core/scene/bending_studies.hpp"

#include <cmath>
#include <numbers>

#include "core/math/parallel.hpp"
#include "core/scene/patch_study.hpp"

namespace pliant::scene {

using base::TerminationType;
using interlock::BendingLimit;

namespace {

class BendingTestStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<BendingTestResult>();
    result->patch = cut();
    const interlock::PatchSolver solver(*result->patch, equilibriumOptions());
    result->limit = bendingLimit(solver, options_["direction"], options_["bend"] == "down", bendingOptions(), &context);
    // A fold is an answer too: that there is no limit. Only where contact did not settle the study has failed.
    finish(*result, result->limit.equilibrium.termination, result->limit.equilibrium.message, watch);
    context.reportProgress(1);
    if (observe) observe(result);
    return result;
  }
};

/// The first limit that has not settled says how a study of many limits ended.
template <class Items, class Visit>
std::pair<TerminationType, std::string> outcomeOf(const Items& items, const Visit& visit) {
  std::pair<TerminationType, std::string> outcome{TerminationType::converged, ""};
  for (const auto& item : items)
    visit(item, [&](const BendingLimit& limit) {
      if (outcome.first == TerminationType::converged && !limit.equilibrium.converged())
        outcome = {limit.equilibrium.termination, limit.equilibrium.message};
    });
  return outcome;
}

class CurvatureLimitsStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    const auto patch = cut();
    const interlock::PatchSolver solver(*patch, equilibriumOptions());
    std::vector<double> angles(options_["directions"].get<std::size_t>());
    for (std::size_t i = 0; i < angles.size(); ++i)
      angles[i] = std::numbers::pi * static_cast<double>(i) / static_cast<double>(angles.size());
    const auto resultWith = [&](std::vector<interlock::BendingLimits> directions) {
      auto result = std::make_shared<CurvatureLimitsResult>();
      result->patch = patch;
      result->directions = std::move(directions);
      const auto [termination, message] = outcomeOf(result->directions, [](const auto& each, const auto& see) {
        see(each.up);
        see(each.down);
      });
      finish(*result, termination, message, watch);
      return result;
    };
    base::GrowingResults<interlock::BendingLimits>::Observer observeLimits;
    if (observe) observeLimits = [&](const auto& soFar) { observe(resultWith(soFar)); };
    auto result = resultWith(bendingLimits(solver, angles, bendingOptions(), context, observeLimits));
    if (observe) observe(result);
    return result;
  }
};

class BendingSizeStudy final : public PatchStudy {
 public:
  using PatchStudy::PatchStudy;

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    using Size = BendingSizeResult::Size;
    const base::Stopwatch watch;
    std::vector<std::shared_ptr<const interlock::UnitCell>> patches;
    std::vector<std::unique_ptr<interlock::PatchSolver>> solvers;
    std::vector<Size> sizes;
    for (const Json& radius : options_["radii"]) {
      interlock::PatchOutline outline;
      outline.centre = {options_["centre"][0].get<double>(), options_["centre"][1].get<double>()};
      outline.radius = radius;
      patches.push_back(cut(outline));
      solvers.push_back(std::make_unique<interlock::PatchSolver>(*patches.back(), equilibriumOptions()));
      Size& size = sizes.emplace_back(Size{outline.radius, static_cast<int>(patches.back()->elements.size()), {}});
      for (BendingLimit& limit : size.limits) limit.equilibrium.termination = TerminationType::cancelled;
    }
    const auto resultWith = [&](std::vector<Size> all) {
      auto result = std::make_shared<BendingSizeResult>();
      result->patch = patches.back();
      result->sizes = std::move(all);
      const auto [termination, message] = outcomeOf(result->sizes, [](const Size& size, const auto& see) {
        for (const BendingLimit& limit : size.limits) see(limit);
      });
      finish(*result, termination, message, watch);
      return result;
    };
    base::GrowingResults<Size>::Observer observeSizes;
    if (observe) observeSizes = [&](const std::vector<Size>& soFar) { observe(resultWith(soFar)); };
    constexpr int tests = static_cast<int>(BendingSizeResult::names.size());
    const int count = tests * static_cast<int>(solvers.size());
    base::GrowingResults<Size> growing(sizes, count, context, observeSizes);
    // The largest first, since they take longest.
    math::parallelFor(count, [&](int k) {
      if (context.cancelRequested()) return;
      const int i = static_cast<int>(solvers.size()) - 1 - k / tests, test = k % tests;
      BendingLimit limit = limitOf(*solvers[i], test, context);
      growing.add([&](std::vector<Size>& all) { all[i].limits[test] = std::move(limit); });
    });
    auto result = resultWith(std::move(sizes));
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

}  // namespace

std::unique_ptr<Study> makeBendingTestStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                            const Json& options) {
  return std::make_unique<BendingTestStudy>(scene, options);
}

std::unique_ptr<Study> makeCurvatureLimitsStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                                const Json& options) {
  return std::make_unique<CurvatureLimitsStudy>(scene, options);
}

std::unique_ptr<Study> makeBendingSizeStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                            const Json& options) {
  return std::make_unique<BendingSizeStudy>(scene, options);
}

}  // namespace pliant::scene
