#include "core/harmonic/multi_start.hpp"

#include <algorithm>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/design_space.hpp"

namespace pliant::harmonic {

namespace {

/// How good a design is: one that keeps the constraints before one that breaks them, then by the objective or by how
/// far they are broken.
struct DesignMerit {
  double violation = 0;  ///< in units of the constraints' scales
  double objective = 0;

  bool operator<(const DesignMerit& other) const {
    const bool holds = violation <= constraintTolerance, otherHolds = other.violation <= constraintTolerance;
    if (holds != otherHolds) return holds;
    return holds ? objective < other.objective : violation < other.violation;
  }
};

double violationOf(const std::vector<DesignConstraint>& constraints, const HarmonicBalanceProblem& problem,
                   const Vector& z) {
  double largest = 0;
  for (const DesignConstraint& constraint : constraints) {
    const double value = constraint.quantity->evaluate(problem, z).value;
    largest = std::max(
        {largest, (constraint.lower - value) / constraint.scale, (value - constraint.upper) / constraint.scale});
  }
  return largest;
}

template <class T>
void putFirst(const T& first, std::vector<T>& list) {
  list.push_back(first);
  std::rotate(list.begin(), list.end() - 1, list.end());
}

/// What the starts are chosen for.
struct DesignGoal {
  const DesignObjective& objective;
  const std::vector<DesignConstraint>& constraints;
};

/// The problem's own model, and those of the best of the sampled designs, the best first.
std::vector<std::shared_ptr<const Model>> firstModels(const HarmonicBalanceProblem& problem, const DesignGoal& goal,
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
  std::vector<std::pair<DesignMerit, std::shared_ptr<const Model>>> ranked;
  for (std::size_t i = 1; i < space.designs.size(); ++i) {
    const SampledDesign& design = space.designs[i];
    if (design.origin == MotionOrigin::none) continue;
    const HarmonicBalanceProblem there(design.model, problem.basis(), problem.drivePeriods());
    ranked.emplace_back(
        DesignMerit{violationOf(goal.constraints, there, design.z), goal.objective.evaluate(there, design.z).value},
        design.model);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::shared_ptr<const Model>> models = {problem.sharedModel()};
  for (std::size_t i = 0; i < ranked.size() && static_cast<int>(i) < count; ++i) models.push_back(ranked[i].second);
  return models;
}

}  // namespace

MultiStartResult designFromSeveralStarts(const HarmonicBalanceProblem& problem, const DesignObjective& objective,
                                         const std::vector<DesignConstraint>& constraints,
                                         const InverseDesignOptions& options, int starts, unsigned seed,
                                         base::ExecutionContext& context,
                                         const std::function<void(const DesignIterate&)>& onIterate) {
  const base::Stopwatch watch;
  const std::vector<std::shared_ptr<const Model>> models =
      firstModels(problem, {objective, constraints}, options, starts - 1, seed, context);
  MultiStartResult all;
  int evaluations = 0, solves = 0, failed = 0;
  DesignIterate own;
  std::vector<ConstraintState> ownStates;
  DesignMerit best;
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (i > 0 && context.cancelRequested()) break;
    const double parts = static_cast<double>(models.size()) + 1;
    context.setRange(static_cast<double>(i + 1) / parts, static_cast<double>(i + 2) / parts);
    const HarmonicBalanceProblem first(models[i], problem.basis(), problem.drivePeriods());
    ConstrainedDesignResult found =
        constraints.empty()
            ? ConstrainedDesignResult{designInversely(first, objective, options, context, onIterate), {}, {}}
            : designWithConstraints(first, objective, constraints, options, context, onIterate);
    const std::vector<DesignIterate>& history = found.design.history;
    evaluations += found.design.evaluations;
    solves += found.design.solves;
    failed += found.design.failedDesigns;
    DesignStart& start = all.starts.emplace_back();
    start.termination = found.design.report.termination;
    bool isBest = i == 0;
    if (!history.empty()) {
      start.values = history.front().values;
      start.objective = history.front().objective;
      start.reached = history.back().objective;
      start.violation = found.optimality.violation;
      start.designs = static_cast<int>(history.size());
      if (i == 0) own = history.front();
      if (i == 0 && !found.states.empty()) ownStates = found.states.front();
      const DesignMerit merit{start.violation, start.reached};
      isBest = isBest || all.found.design.history.empty() || merit < best;
      if (isBest) best = merit;
    }
    if (!isBest) continue;
    all.found = std::move(found);
    all.best = static_cast<int>(i);
  }
  InverseDesignResult& design = all.found.design;
  if (all.best > 0 && own.model) {
    putFirst(own, design.history);
    if (!constraints.empty()) putFirst(ownStates, all.found.states);
    for (std::size_t i = 0; i < design.history.size(); ++i) design.history[i].iteration = static_cast<int>(i);
  }
  design.evaluations = evaluations;
  design.solves = solves;
  design.failedDesigns = failed;
  design.report.seconds = watch.seconds();
  if (context.cancelRequested()) design.report.termination = base::TerminationType::cancelled;
  return all;
}

}  // namespace pliant::harmonic
