#pragma once

#include <vector>

#include "core/harmonic/linearization.hpp"

namespace pliant::harmonic {

struct LinearModesOptions {
  int count = 6;             ///< of modes, from the lowest frequency upwards
  double tolerance = 1e-11;  ///< of 1/ω², relative to the largest
  int maximumIterations = 300;
};

/// K φ = ω² M φ.
struct LinearMode {
  double omega = 0;  ///< natural frequency without damping [rad/s]
  /// ζ = (D_α/ω + D_β ω)/2. The damped mode oscillates with ω √(1 - ζ²) while ζ < 1.
  double dampingRatio = 0;
  /// √(rᵀK⁻¹r) ω²/√(φᵀKφ) with r = Mφ - Kφ/ω²: some eigenvalue 1/ω² of the model differs from this one by no more
  /// than this fraction of it (Krylov and Weinstein's bound in the norm of K).
  double residual = 0;
  Vector shape;  ///< φ over the free coordinates with φᵀMφ = 1 [1/√kg]; the largest entry is positive
};

struct LinearModes {
  std::vector<LinearMode> modes;  ///< by rising frequency; fewer than asked for where the model has fewer
  Vector equilibrium;             ///< positions of all coordinates [m] about which the model was linearised
  base::SolverReport report;
};

/// Linear modal analysis about the static equilibrium under the steady part of the loads and drives, driven nodes held.
/// Solves M φ = ν K φ for the largest ν = 1/ω² by Lanczos' method with implicit restarts (the inverse iteration of
/// Spectra in the inner product of K), so M may be singular: massless coordinates follow the others and have no mode.
/// Small models are solved densely. That no lower mode was missed is checked by Sylvester's law of inertia. Fails with
/// a sentence where linearizeAtEquilibrium does.
LinearModes computeLinearModes(const HarmonicBalanceProblem& problem, const LinearModesOptions& options,
                               base::ExecutionContext& context);

}  // namespace pliant::harmonic
