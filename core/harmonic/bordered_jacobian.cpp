#include "core/harmonic/bordered_jacobian.hpp"

#include <random>

#include "core/base/stopwatch.hpp"

namespace pliant::harmonic {

BorderedJacobian::BorderedJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega)
    : problem_(problem) {
  const Eigen::Index n = problem.size();
  Vector h, frequencyDerivative;
  SparseMatrix jacobian;
  problem.linearize(z, omega, h, &jacobian, &frequencyDerivative);
  Vector scale = Vector::Constant(n + 1, problem.oscillation(z).norm());
  scale[n] = omega;
  if (!(scale[0] > 0)) return;
  // Any border that the tangent is not perpendicular to gives the tangent; that one then is the best border.
  std::mt19937 random(11);
  Vector border(n + 1);
  for (double& entry : border) entry = static_cast<double>(random()) / 4294967296.0 - 0.5;
  border.array() /= scale.array();
  if (!factorize(jacobian, frequencyDerivative, border)) return;
  tangent_ = solve(Vector::Unit(n + 1, n));
  tangent_ /= tangent_.cwiseQuotient(scale).norm();
  regular_ = factorize(jacobian, frequencyDerivative, tangent_.cwiseQuotient(scale.cwiseAbs2()));
}

bool BorderedJacobian::factorize(const SparseMatrix& jacobian, const Vector& frequencyDerivative,
                                 const Vector& border) {
  const base::Stopwatch watch;
  const Eigen::Index n = jacobian.rows();
  const Vector column = problem_.restricted(frequencyDerivative), row = restricted(border);
  SparseMatrix bordered(n + 1, n + 1);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(jacobian.nonZeros() + 2 * n + 1));
  for (Eigen::Index j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator it(jacobian, j); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
    entries.emplace_back(static_cast<int>(n), static_cast<int>(j), row[j]);
    entries.emplace_back(static_cast<int>(j), static_cast<int>(n), column[j]);
  }
  entries.emplace_back(static_cast<int>(n), static_cast<int>(n), row[n]);
  bordered.setFromTriplets(entries.begin(), entries.end());
  const bool regular = factors_.factorize(bordered);
  ++problem_.cost().factorizations;
  problem_.cost().factorizationSeconds += watch.seconds();
  return regular;
}

Matrix BorderedJacobian::restricted(const Matrix& x) const {
  const Matrix state = problem_.restricted(x.topRows(problem_.size()));
  Matrix result(state.rows() + 1, x.cols());
  result << state, x.bottomRows(1);
  return result;
}

Matrix BorderedJacobian::expanded(const Matrix& x) const {
  Matrix result(problem_.size() + 1, x.cols());
  result << problem_.expanded(x.topRows(x.rows() - 1)), x.bottomRows(1);
  return result;
}

Vector BorderedJacobian::solve(const Vector& right) const { return expanded(factors_.solve(restricted(right))); }

Matrix BorderedJacobian::solveTransposed(const Matrix& right) const {
  return expanded(factors_.solveTransposed(restricted(right)));
}

}  // namespace pliant::harmonic
