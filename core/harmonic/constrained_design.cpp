#include "core/harmonic/constrained_design.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/design_branch.hpp"
#include "core/harmonic/design_gradient.hpp"

namespace pliant::harmonic {

namespace {

using solvers::ConstrainedValue;

/// A design that was evaluated. Problems and factors are too large to keep for all of them.
struct MetDesign {
  Vector variables;
  std::shared_ptr<const Model> model;
  Vector z;
};

/// Objective and constraints over the variables, by following the branch of motions, each in a unit of its own.
class ConstrainedOnBranch final : public solvers::ConstrainedFunction {
 public:
  ConstrainedOnBranch(DesignBranch& branch, const DesignObjective& objective,
                      const std::vector<DesignConstraint>& constraints, const InverseDesignOptions& options,
                      DesignPoint first)
      : branch_(branch),
        objective_(objective),
        constraints_(constraints),
        options_(options),
        base_(first),
        last_(std::move(first)) {}

  std::optional<ConstrainedValue> evaluate(const Vector& variables, bool withDerivatives) override {
    if (variables != last_.variables) {
      if ((variables - base_.variables).norm() < (variables - last_.variables).norm()) last_ = base_;
      if (!branch_.follow(last_, variables)) {
        ++failures_;
        return std::nullopt;
      }
    }
    remember();
    const auto count = static_cast<Eigen::Index>(constraints_.size());
    ConstrainedValue result;
    result.constraints.resize(count);
    if (!withDerivatives) {
      result.objective = objective_.evaluate(*last_.problem, last_.motion.z).value * objectiveScale_;
      for (Eigen::Index i = 0; i < count; ++i) {
        const DesignConstraint& constraint = constraintAt(i);
        result.constraints[i] = constraint.quantity->evaluate(*last_.problem, last_.motion.z).value / constraint.scale;
      }
      return withValue(std::move(result));
    }
    result.jacobian.resize(count, variables.size());
    const DesignGradient objective = gradientOf(objective_);
    if (!objective.regular) return std::nullopt;
    if (objectiveScale_ == 1) {
      const double size = objective.gradient.cwiseProduct(branch_.ranges()).cwiseAbs().maxCoeff();
      if (size > 0) objectiveScale_ = 1 / size;
    }
    result.objective = objective.value * objectiveScale_;
    result.gradient = objective.gradient.cwiseProduct(branch_.ranges()) * objectiveScale_;
    for (Eigen::Index i = 0; i < count; ++i) {
      const DesignGradient at = gradientOf(*constraintAt(i).quantity);
      if (!at.regular) return std::nullopt;
      result.constraints[i] = at.value / constraintAt(i).scale;
      result.jacobian.row(i) = at.gradient.cwiseProduct(branch_.ranges()).transpose() / constraintAt(i).scale;
    }
    base_ = last_;
    return withValue(std::move(result));
  }

  const MetDesign& designAt(const Vector& variables) const {
    return *std::find_if(met_.rbegin(), met_.rend(), [&](const MetDesign& met) { return met.variables == variables; });
  }
  double objectiveScale() const { return objectiveScale_; }
  int failures() const { return failures_; }

 private:
  /// None if something is infinite, as where a design has no resonance to be placed.
  std::optional<ConstrainedValue> withValue(ConstrainedValue value) {
    if (std::isfinite(value.objective) && value.constraints.allFinite()) return value;
    ++failures_;
    return std::nullopt;
  }
  const DesignConstraint& constraintAt(Eigen::Index i) const { return constraints_[static_cast<std::size_t>(i)]; }
  DesignGradient gradientOf(const DesignObjective& quantity) const {
    return designGradient(*last_.problem, last_.motion, quantity, options_.parameters, *last_.byParameters);
  }
  void remember() {
    if (!met_.empty() && met_.back().variables == last_.variables) return;
    met_.push_back({last_.variables, last_.problem->sharedModel(), last_.motion.z});
  }

  DesignBranch& branch_;
  const DesignObjective& objective_;
  const std::vector<DesignConstraint>& constraints_;
  const InverseDesignOptions& options_;
  DesignPoint base_;  ///< differentiated last
  DesignPoint last_;  ///< reached last
  std::vector<MetDesign> met_;
  double objectiveScale_ = 1;  ///< by which the first gradient's largest component becomes 1
  int failures_ = 0;
};

solvers::ConstrainedBounds boundsOf(const std::vector<DesignConstraint>& constraints, Eigen::Index variables) {
  const auto count = static_cast<Eigen::Index>(constraints.size());
  solvers::ConstrainedBounds bounds{Vector::Zero(variables), Vector::Ones(variables), Vector(count), Vector(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const DesignConstraint& constraint = constraints[static_cast<std::size_t>(i)];
    bounds.constraintLower[i] = constraint.lower / constraint.scale;
    bounds.constraintUpper[i] = constraint.upper / constraint.scale;
  }
  return bounds;
}

/// Writes down designs on the way.
class DesignRecorder {
 public:
  DesignRecorder(const HarmonicBalanceProblem& first, const std::vector<DesignConstraint>& constraints,
                 const DesignBranch& branch, const ConstrainedOnBranch& onBranch,
                 const solvers::ConstrainedBounds& bounds, const std::function<void(const DesignIterate&)>& onIterate,
                 ConstrainedDesignResult& result)
      : first_(first),
        constraints_(constraints),
        branch_(branch),
        onBranch_(onBranch),
        bounds_(bounds),
        onIterate_(onIterate),
        result_(result) {}

  void add(const Vector& variables, const ConstrainedValue& value, double stepLength, int evaluations) {
    const MetDesign& met = onBranch_.designAt(variables);
    const HarmonicBalanceProblem problem(
        met.model, first_.basis(), first_.drivePeriods(), first_.coordinateHarmonics());
    DesignIterate design;
    design.iteration = static_cast<int>(result_.design.history.size());
    design.model = met.model;
    design.values = branch_.valuesOf(variables);
    design.z = met.z;
    for (const mechanics::Probe& probe : design.model->probes)
      design.amplitudes.push_back(amplitude(problem, design.z, probe.node));
    design.objective = value.objective / onBranch_.objectiveScale();
    if (value.gradient.size() > 0)
      design.projectedGradient = solvers::optimalityOf(value, variables, bounds_).stationarity *
                                 value.gradient.cwiseAbs().maxCoeff() / onBranch_.objectiveScale();
    design.stepLength = stepLength;
    design.evaluations = evaluations;
    design.solves = branch_.solves() + 1;
    std::vector<ConstraintState> states;
    for (std::size_t i = 0; i < constraints_.size(); ++i)
      states.push_back({value.constraints[static_cast<Eigen::Index>(i)] * constraints_[i].scale,
                        constraints_[i].quantity->exactValue(problem, design.z)});
    result_.states.push_back(std::move(states));
    result_.design.evaluations = evaluations;
    result_.design.history.push_back(design);
    if (onIterate_) onIterate_(design);
  }

 private:
  const HarmonicBalanceProblem& first_;
  const std::vector<DesignConstraint>& constraints_;
  const DesignBranch& branch_;
  const ConstrainedOnBranch& onBranch_;
  const solvers::ConstrainedBounds& bounds_;
  const std::function<void(const DesignIterate&)>& onIterate_;
  ConstrainedDesignResult& result_;
};

}  // namespace

ConstrainedDesignResult designWithConstraints(HarmonicBalanceProblem problem, const DesignObjective& objective,
                                              const std::vector<DesignConstraint>& constraints,
                                              const InverseDesignOptions& options, base::ExecutionContext& context,
                                              const std::function<void(const DesignIterate&)>& onIterate) {
  const base::Stopwatch watch;
  ConstrainedDesignResult result;
  base::SolverReport& report = result.design.report;
  DesignBranch branch(problem, options, context);
  DesignPoint first = branch.begin();
  if (!first.motion.report.converged()) {
    report = first.motion.report;
    report.seconds = watch.seconds();
    return result;
  }
  const Vector start = first.variables;
  ConstrainedOnBranch onBranch(branch, objective, constraints, options, std::move(first));
  const solvers::ConstrainedBounds bounds = boundsOf(constraints, start.size());
  DesignRecorder recorder(problem, constraints, branch, onBranch, bounds, onIterate, result);
  const auto before = onBranch.evaluate(start, true);
  if (!before) {
    report.message = "The first design has no derivatives: its motion stands at a fold, or its objective is infinite.";
    return result;
  }
  recorder.add(start, *before, 0, 1);
  const auto accept = [&](const solvers::ConstrainedIterate& iterate) {
    if (iterate.x != start) recorder.add(iterate.x, iterate.value, iterate.stepLength, iterate.evaluations + 1);
  };
  solvers::ConstrainedOptions chosen;
  chosen.maximumIterations = options.optimizer.maximumIterations;
  chosen.tolerance = options.optimizer.gradientTolerance;
  chosen.constraintTolerance = constraintTolerance;
  solvers::ConstrainedSolution solution =
      solvers::minimizeWithConstraints(onBranch, start, bounds, chosen, context, accept);
  // Ipopt starts a little inside the bounds and so may never have met the first design.
  const solvers::Optimality atStart = solvers::optimalityOf(*before, start, bounds);
  const bool startHolds = atStart.violation <= constraintTolerance;
  const bool isWorse = solution.x.size() == 0 || (startHolds ? solution.optimality.violation > constraintTolerance ||
                                                                   before->objective < solution.value.objective
                                                             : atStart.violation < solution.optimality.violation);
  if (isWorse) {
    solution.x = start;
    solution.value = *before;
    solution.optimality = atStart;
  }
  if (const Vector last = branch.valuesOf(solution.x); result.design.history.back().values != last)
    recorder.add(solution.x, solution.value, 0, solution.evaluations + 1);
  report = solution.report;
  report.seconds = watch.seconds();
  result.optimality = solution.optimality;
  result.optimality.multipliers.resize(static_cast<Eigen::Index>(constraints.size()));
  if (solution.optimality.multipliers.size() == 0) result.optimality.multipliers.setZero();
  for (Eigen::Index i = 0; i < result.optimality.multipliers.size(); ++i)
    result.optimality.multipliers[i] /= onBranch.objectiveScale() * constraints[static_cast<std::size_t>(i)].scale;
  result.design.evaluations = solution.evaluations + 1;
  result.design.solves = branch.solves() + 1;
  result.design.failedDesigns = onBranch.failures();
  result.design.cost = branch.cost();
  return result;
}

}  // namespace pliant::harmonic
