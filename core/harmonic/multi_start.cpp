#include "core/harmonic/multi_start.hpp"

#include <algorithm>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/design_space.hpp"

namespace pliant::harmonic {

namespace {

/// The models of the sampled designs with the lowest objectives, the best first.
std::vector<std::shared_ptr<const Model>> promisingModels(const HarmonicBalanceProblem& problem,
                                                          const DesignObjective& objective,
                                                          const InverseDesignOptions& options, int count, unsigned seed,
                                                          base::ExecutionContext& context) {
  constexpr int samplesPerStart = 4;
  DesignSpaceOptions sampling;
  sampling.omega = options.omega;
  sampling.parameters = options.parameters;
  sampling.count = samplesPerStart * count;
  sampling.seed = seed;
  sampling.motion = options.motion;
  sampling.progress = 1.0 / (count + 2);
  const DesignSpace space = sampleDesignSpace(problem, sampling, context);
  std::vector<std::pair<double, std::shared_ptr<const Model>>> ranked;
  for (std::size_t i = 1; i < space.designs.size(); ++i) {
    const SampledDesign& design = space.designs[i];
    if (design.origin == MotionOrigin::none) continue;
    const HarmonicBalanceProblem there(design.model, problem.basis(), problem.drivePeriods());
    ranked.emplace_back(objective.evaluate(there, design.z).value, design.model);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::shared_ptr<const Model>> models;
  for (std::size_t i = 0; i < ranked.size() && static_cast<int>(i) < count; ++i) models.push_back(ranked[i].second);
  return models;
}

}  // namespace

MultiStartResult designFromSeveralStarts(const HarmonicBalanceProblem& problem, const DesignObjective& objective,
                                         const InverseDesignOptions& options, int starts, unsigned seed,
                                         base::ExecutionContext& context,
                                         const std::function<void(const DesignIterate&)>& onIterate) {
  const base::Stopwatch watch;
  std::vector<std::shared_ptr<const Model>> models =
      promisingModels(problem, objective, options, starts - 1, seed, context);
  models.insert(models.begin(), problem.sharedModel());
  MultiStartResult result;
  int evaluations = 0, solves = 0, failed = 0;
  DesignIterate own;
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (i > 0 && context.cancelRequested()) break;
    const double parts = static_cast<double>(models.size()) + 1;
    context.setRange(static_cast<double>(i + 1) / parts, static_cast<double>(i + 2) / parts);
    InverseDesignResult found =
        designInversely(HarmonicBalanceProblem(models[i], problem.basis(), problem.drivePeriods()), objective, options,
                        context, onIterate);
    evaluations += found.evaluations;
    solves += found.solves;
    failed += found.failedDesigns;
    DesignStart& start = result.starts.emplace_back();
    start.termination = found.report.termination;
    if (!found.history.empty()) {
      start.values = found.history.front().values;
      start.objective = found.history.front().objective;
      start.reached = found.history.back().objective;
      start.designs = static_cast<int>(found.history.size());
      if (i == 0) own = found.history.front();
    }
    const bool better = !found.history.empty() &&
                        (result.design.history.empty() || start.reached < result.design.history.back().objective);
    if (i == 0 || better) {
      result.design = std::move(found);
      result.best = static_cast<int>(i);
    }
  }
  if (result.best > 0 && own.model) {
    result.design.history.insert(result.design.history.begin(), own);
    for (std::size_t i = 0; i < result.design.history.size(); ++i)
      result.design.history[i].iteration = static_cast<int>(i);
  }
  result.design.evaluations = evaluations;
  result.design.solves = solves;
  result.design.failedDesigns = failed;
  result.design.report.seconds = watch.seconds();
  if (context.cancelRequested()) result.design.report.termination = base::TerminationType::cancelled;
  return result;
}

}  // namespace pliant::harmonic
