#pragma once

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// How far a node swings in one period.
struct Amplitude {
  double pathLength = 0;           ///< length of the closed polygon of N samples (2.3.14) [m]
  double maximumDisplacement = 0;  ///< largest distance from the mean position over the samples [m]
};

Amplitude amplitude(const HarmonicBalanceProblem& problem, const Vector& z, int node);

/// Derivative of the path length by z, of the very polygon that `amplitude` measures (size()); segments of zero length
/// contribute nothing.
Vector pathLengthGradient(const HarmonicBalanceProblem& problem, const Vector& z, int node);

}  // namespace pliant::harmonic
