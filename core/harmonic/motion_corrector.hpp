#pragma once

#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/periodic_motion.hpp"

namespace pliant::harmonic {

/// Newton's method at one frequency from `z` alone, for those who follow motions themselves. `z` is the start and the
/// answer. If it was extrapolated by linearisation from another motion, that is `stresses.from` (`to` is not read),
/// with its fraction of the drive: see "Thin shells" in README.md. `solver` keeps the factors of the last iteration.
base::SolverReport correctMotion(const HarmonicBalanceProblem& problem, JacobianSolver& solver, double omega,
                                 const PeriodicMotionOptions& options, StressSource stresses, Vector& z,
                                 base::ExecutionContext& context);

}  // namespace pliant::harmonic
