#pragma once

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// How far a node swings in one period; of two frequencies the mean over periods of the first one, and the largest
/// distance at any time. Both numbers belong to the trigonometric polynomial itself, not to samples of
/// it: a polygon of 64 samples is up to 0.1 % short by an amount that changes with the phase, which would move the
/// resonance peaks of a response curve and add false ones.
struct Amplitude {
  double pathLength = 0;           ///< ∫ ‖dx/dτ‖ dτ over a period (2.3.14) [m]
  double maximumDisplacement = 0;  ///< largest distance from the mean position [m]
};

Amplitude amplitude(const HarmonicBalanceProblem& problem, const Vector& z, int node);

/// Derivative of the path length by z (size()); instants of zero speed contribute nothing.
Vector pathLengthGradient(const HarmonicBalanceProblem& problem, const Vector& z, int node);

/// Largest strain of any triangle (in its plane) or tetrahedron at as many instants of a period as there are samples,
/// but no fewer than 64 (of two frequencies at the samples of the torus): its largest principal stretch minus 1. 0 for
/// a model without them.
double largestStrain(const HarmonicBalanceProblem& problem, const Vector& z);

}  // namespace pliant::harmonic
