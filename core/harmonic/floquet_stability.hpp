#pragma once

#include <complex>
#include <vector>

#include "core/harmonic/jacobian_solver.hpp"

namespace pliant::harmonic {

/// log|μ| that rounding can pretend: multipliers this close outside the unit circle still count as on it.
constexpr double unitCircleTolerance = 1e-6;

/// What becomes of small disturbances of a periodic motion.
enum class StabilityState {
  unknown,   ///< not asked for, or not all that matters of it was found
  stable,    ///< they die away
  unstable,  ///< some grow
};

struct Stability {
  StabilityState state = StabilityState::unknown;
  /// Floquet multipliers outside the unit circle. At a located bifurcation: without the one (or pair) that is on it.
  int unstableCount = 0;
  /// The multipliers of largest modulus, in that order: by which factor a disturbance changes over one period of z
  /// (`HarmonicBalanceProblem::drivePeriods` periods of the drive). Those of quickly dying disturbances are left out.
  std::vector<std::complex<double>> multipliers;
};

/// Stability by Hill's method (see HillOperator): Arnoldi's method with the factors of ∂h/∂z finds the exponents near
/// zero; of the copies ρ + i k of each, which differ by what the truncation to H harmonics does to them, the one counts
/// whose disturbance has least in the highest harmonic. Disturbances that live in that harmonic alone are left out: of
/// motions with frequencies above H ω the series knows nothing.
/// The sign of det(∂h/∂z) tells whether the number of real positive exponents is even or odd; where that contradicts
/// what was found, the search is widened, and the state is unknown if that does not help.
/// Unknown of two frequencies: disturbances have no period there, and so no multipliers.
/// `solver` must be linearised (exactly) and factorised at the motion.
Stability floquetStability(const HarmonicBalanceProblem& problem, const JacobianSolver& solver, double omega);
/// The same of any solution; factorises ∂h/∂z there. Unknown if it is singular.
Stability floquetStability(const HarmonicBalanceProblem& problem, const Vector& z, double omega);

}  // namespace pliant::harmonic
