#pragma once

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

struct PeriodicMotionOptions {
  double tolerance = 1e-9;       ///< on ‖h‖ / forceScale
  double stepTolerance = 1e-10;  ///< a correction of z below this, relative to the swing, also counts as converged
  int maximumIterations = 40;    ///< Newton iterations a drive level
  int maximumRampSteps = 64;     ///< levels by which the drive may be ramped up where Newton from rest fails
  /// Factor on the linear response that Newton's method starts from. Others than 1, also negative ones, lead to other
  /// motions where there are several; the drive is not ramped up then, since that leads back to the usual one.
  double startScale = 1;
};

/// One periodic solution.
struct PeriodicMotion {
  double omega = 0;           ///< [rad/s]
  Vector z;                   ///< coefficients, see HarmonicBalanceProblem
  base::SolverReport report;  ///< residual: ‖h‖ / forceScale; correction: relative to the swing
  /// Factors of ∂h/∂z at, or close to, the solution: what the last Newton iteration left behind. May be null.
  std::shared_ptr<const math::SparseFactorization> factorization;
};

/// Newton's method with a line search from `start`. Without one, or where it fails: from the static equilibrium under
/// the steady load plus the linear response to the drive; where that fails too, the drive is ramped up by continuation,
/// and at last the response is followed from lower frequencies.
/// Fails with a sentence that names a node and an axis if nothing holds the model there at rest.
PeriodicMotion solvePeriodicMotion(HarmonicBalanceProblem& problem, double omega, const PeriodicMotionOptions& options,
                                   base::ExecutionContext& context, const Vector& start = {});

/// Raises the number of harmonics from `problem`'s by two at a time (thesis 2.5.1; odd and even ones come in pairs,
/// since symmetric models answer with one kind alone) until no probe's trajectory changes by more than `relativeChange`
/// of its path length, up to `maximumHarmonics`; samples grow to at least 4H+1. Without probes all nodes count. Returns
/// the problem with the harmonics that were enough and its motion; if `maximumHarmonics` were not enough, the report
/// says iterationLimit.
std::pair<HarmonicBalanceProblem, PeriodicMotion> solveWithAdaptiveHarmonics(HarmonicBalanceProblem problem,
                                                                             double omega, double relativeChange,
                                                                             int maximumHarmonics,
                                                                             const PeriodicMotionOptions& options,
                                                                             base::ExecutionContext& context);

}  // namespace pliant::harmonic
