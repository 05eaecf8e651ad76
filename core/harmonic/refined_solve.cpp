#include "core/harmonic/refined_solve.hpp"

#include <algorithm>

namespace pliant::harmonic {

bool solveRefined(const SparseMatrix& jacobian, const math::SparseFactorization& factors, bool transposed,
                  const Matrix& b, Matrix& x) {
  constexpr int maximumIterations = 10;
  constexpr double tolerance = 1e-12;
  const auto solve = [&](const Matrix& right) {
    return transposed ? factors.solveTransposed(right) : factors.solve(right);
  };
  x = solve(b);
  double previous = 1;
  for (int iteration = 0; iteration < maximumIterations; ++iteration) {
    const Matrix product = transposed ? Matrix(jacobian.transpose() * x) : Matrix(jacobian * x);
    const Matrix correction = solve(b - product);
    x += correction;
    double size = 0;  // of the correction relative to the answer, of the worst column
    for (Eigen::Index p = 0; p < x.cols(); ++p)
      if (x.col(p).norm() > 0) size = std::max(size, correction.col(p).norm() / x.col(p).norm());
    if (size <= tolerance) return true;
    if (!(size <= 0.3 * previous)) return previous <= 1e-10;  // rounding may stop it just above the tolerance
    previous = size;
  }
  return false;
}

}  // namespace pliant::harmonic
