#pragma once

#include "core/math/harmonic_basis.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::harmonic {

using mechanics::Matrix;
using mechanics::Vector;

/// Mean length of a path with two frequencies (HarmonicBasis::ofTwoFrequencies) in a period of the first one: 2π/ν
/// times the mean of ‖dx/dτ‖ over the torus of phases, which is its mean in time as well (Weyl 1916). By the
/// trapezoidal rule on a grid; otherwise like `pathLength`.
double meanPathLength(const math::HarmonicBasis& basis, const Matrix& coefficients, Matrix* gradient = nullptr);

/// Largest distance of the path from its mean at any phases [m].
double largestDisplacement(const math::HarmonicBasis& basis, const Matrix& coefficients);

}  // namespace pliant::harmonic
