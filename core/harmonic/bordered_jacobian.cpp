#include "core/harmonic/bordered_jacobian.hpp"

#include <random>

#include "core/base/stopwatch.hpp"

namespace pliant::harmonic {

BorderedJacobian::BorderedJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega,
                                   const Vector* border, const StressSource* stresses)
    : problem_(problem) {
  const Eigen::Index n = problem.size();
  Vector frequencyDerivative;
  SparseMatrix jacobian;
  problem.linearize(z, omega, residual_, &jacobian, &frequencyDerivative, stresses);
  scale_ = Vector::Constant(n + 1, problem.oscillation(z).norm());
  scale_[n] = omega;
  if (!(scale_[0] > 0)) return;
  const auto dual = [&](const Vector& vector) -> Vector { return vector.cwiseQuotient(scale_.cwiseAbs2()); };
  const auto findTangent = [&] {
    tangent_ = solve(Vector::Unit(n + 1, n));
    tangent_ /= length(tangent_);
    return tangent_.allFinite();
  };
  if (border) {
    regular_ = factorize(jacobian, frequencyDerivative, dual(*border)) && findTangent();
    return;
  }
  // Any border that the tangent is not perpendicular to gives the tangent; that one then is the best border.
  std::mt19937 random(11);
  Vector any(n + 1);
  for (double& entry : any) entry = static_cast<double>(random()) / 4294967296.0 - 0.5;
  regular_ = factorize(jacobian, frequencyDerivative, any.cwiseQuotient(scale_)) && findTangent() &&
             factorize(jacobian, frequencyDerivative, dual(tangent_));
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
