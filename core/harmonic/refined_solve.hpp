#pragma once

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// J x = b, or Jᵀ x = b, by iterative refinement with factors of a matrix near J; false if it does not converge
/// quickly. `b` is n x m.
bool solveRefined(const SparseMatrix& jacobian, const math::SparseFactorization& factors, bool transposed,
                  const Matrix& b, Matrix& x);

}  // namespace pliant::harmonic
