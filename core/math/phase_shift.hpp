#pragma once

#include <Eigen/Core>

namespace pliant::math {

/// The coefficients of x(τ + φ) from those of x(τ) (columns of 2H+1, see HarmonicBasis): harmonic k turned by kφ.
Eigen::MatrixXd shiftedInPhase(const Eigen::MatrixXd& coefficients, double phase);

}  // namespace pliant::math
