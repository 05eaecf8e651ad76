#pragma once

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

struct PeriodicMotionOptions {
  double tolerance = 1e-9;       ///< on ‖h‖ / forceScale
  int maximumIterations = 40;    ///< Newton iterations a drive level
  int maximumRampSteps = 64;     ///< levels by which the drive may be ramped up where Newton from rest fails
};

/// One periodic solution.
struct PeriodicMotion {
  double omega = 0;  ///< [rad/s]
  Vector z;          ///< coefficients, see HarmonicBalanceProblem
  base::SolverReport report;
};

/// Newton's method with a line search from `start` (from rest, through the static state and a ramped drive, if empty).
PeriodicMotion solvePeriodicMotion(HarmonicBalanceProblem& problem, double omega, const PeriodicMotionOptions& options,
                                   base::ExecutionContext& context, const Vector& start = {});

/// Raises the number of harmonics from `problem`'s (thesis 2.5.1) until no probe's trajectory changes by more than
/// `relativeChange` of its path length, up to `maximumHarmonics`; samples grow to at least 4H+1.
/// Returns the problem with the harmonics that were enough and its motion.
std::pair<HarmonicBalanceProblem, PeriodicMotion> solveWithAdaptiveHarmonics(
    HarmonicBalanceProblem problem, double omega, double relativeChange, int maximumHarmonics,
    const PeriodicMotionOptions& options, base::ExecutionContext& context);

}  // namespace pliant::harmonic
