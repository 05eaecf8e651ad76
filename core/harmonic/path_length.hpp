#pragma once

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// Fourier coefficients of one node's position, driven and locked coordinates included: (2H+1) x dimension [m].
Matrix nodeCoefficients(const HarmonicBalanceProblem& problem, const Vector& z, int node);

/// ∫ ‖dx/dτ‖ dτ over a period (of two frequencies the mean over periods of the first one) (2.3.14) of the path with
/// these coefficients, (2H+1) x any number of coordinates [m], and its derivative by the coefficients if `gradient` is
/// not null; instants of zero speed contribute nothing to it.
double pathLength(const math::HarmonicBasis& basis, const Matrix& coefficients, Matrix* gradient = nullptr);

/// Largest distance of the path from its mean, at any time [m].
double maximumDisplacement(const math::HarmonicBasis& basis, const Matrix& coefficients);

}  // namespace pliant::harmonic
