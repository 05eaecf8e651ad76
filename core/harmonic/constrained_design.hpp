#pragma once

#include "core/harmonic/design_constraint.hpp"
#include "core/harmonic/inverse_design.hpp"
#include "core/solvers/constrained_minimizer.hpp"

namespace pliant::harmonic {

/// A constraint at a design.
struct ConstraintState {
  double value = 0;       ///< of the smooth quantity that is held within bounds
  double exactValue = 0;  ///< of what it bounds
};

struct ConstrainedDesignResult {
  /// As of designInversely, but accepted designs are not always better than the ones before. The last is the answer if
  /// converged, else the best that keeps the constraints, or the one that breaks them least. `projectedGradient` is
  /// what the bounds leave of the Lagrangian's gradient.
  InverseDesignResult design;
  std::vector<std::vector<ConstraintState>> states;  ///< of every design in the history, a constraint each
  /// Of the last design: stationarity relative to the objective's gradient, violation in units of the constraints'
  /// scales, multipliers in units of the objective per unit of a constraint.
  solvers::Optimality optimality;
};

constexpr double constraintTolerance = 1e-6;  ///< of a constraint's scale, by which a design may break it

/// Changes parameters of `problem`'s model within their bounds so that the objective falls and the constraints hold, by
/// Ipopt. The branch of motions is followed as in designInversely; each gradient costs one solve a constraint and one
/// for the objective (2.4.5). The first design need not keep the constraints. Of `options.optimizer` the iterations and
/// the tolerance on the gradient count.
ConstrainedDesignResult designWithConstraints(HarmonicBalanceProblem problem, const DesignObjective& objective,
                                              const std::vector<DesignConstraint>& constraints,
                                              const InverseDesignOptions& options, base::ExecutionContext& context,
                                              const std::function<void(const DesignIterate&)>& onIterate = {});

}  // namespace pliant::harmonic
