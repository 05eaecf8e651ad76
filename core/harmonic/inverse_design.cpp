#include "core/harmonic/inverse_design.hpp"

#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/design_branch.hpp"
#include "core/harmonic/design_gradient.hpp"

namespace pliant::harmonic {

namespace {

/// The objective over the variables, by following the branch of motions.
class ObjectiveOnBranch final : public solvers::BoundedObjective {
 public:
  ObjectiveOnBranch(DesignBranch& branch, const DesignObjective& objective, const InverseDesignOptions& options,
                    DesignPoint first)
      : branch_(branch), objective_(objective), options_(options), base_(first), last_(std::move(first)) {}

  std::optional<double> evaluate(const Vector& variables, Vector& gradient) override {
    if (variables != last_.variables) {
      if ((variables - base_.variables).norm() < (variables - last_.variables).norm()) last_ = base_;
      if (!branch_.follow(last_, variables)) {
        ++failures_;
        return std::nullopt;
      }
    }
    const DesignGradient at =
        designGradient(*last_.problem, last_.motion, objective_, options_.parameters, *last_.byParameters);
    if (!at.regular || !std::isfinite(at.value)) return std::nullopt;
    gradient = at.gradient.cwiseProduct(branch_.ranges());
    return at.value;
  }

  /// The design evaluated last, from now on the one to start others from.
  const DesignPoint& accept() {
    base_ = last_;
    return base_;
  }
  int failures() const { return failures_; }

 private:
  DesignBranch& branch_;
  const DesignObjective& objective_;
  const InverseDesignOptions& options_;
  DesignPoint base_;  ///< accepted last
  DesignPoint last_;  ///< reached last
  int failures_ = 0;
};

}  // namespace

InverseDesignResult designInversely(HarmonicBalanceProblem problem, const DesignObjective& objective,
                                    const InverseDesignOptions& options, base::ExecutionContext& context,
                                    const std::function<void(const DesignIterate&)>& onIterate) {
  const base::Stopwatch watch;
  InverseDesignResult result;
  DesignBranch branch(problem, options, context);
  DesignPoint first = branch.begin();
  if (!first.motion.report.converged()) {
    result.report = first.motion.report;
    result.report.seconds = watch.seconds();
    return result;
  }
  Vector variables = first.variables;
  ObjectiveOnBranch onBranch(branch, objective, options, std::move(first));
  const auto accept = [&](const solvers::BoundedIterate& iterate) {
    const DesignPoint& point = onBranch.accept();
    DesignIterate design;
    design.iteration = iterate.iteration;
    design.model = point.problem->sharedModel();
    design.values = branch.valuesOf(point.variables);
    design.z = point.motion.z;
    for (const mechanics::Probe& probe : design.model->probes)
      design.amplitudes.push_back(amplitude(*point.problem, design.z, probe.node));
    design.objective = iterate.value;
    design.projectedGradient = iterate.projectedGradient;
    design.stepLength = iterate.stepLength;
    design.evaluations = iterate.evaluations;
    design.solves = branch.solves() + 1;
    result.evaluations = iterate.evaluations;
    result.history.push_back(design);
    if (onIterate) onIterate(design);
  };
  result.report = solvers::minimizeWithinBounds(onBranch, variables, Vector::Zero(variables.size()),
                                                Vector::Ones(variables.size()), options.optimizer, context, accept);
  result.report.seconds = watch.seconds();
  result.solves = branch.solves() + 1;
  result.failedDesigns = onBranch.failures();
  result.cost = branch.cost();
  return result;
}

}  // namespace pliant::harmonic
