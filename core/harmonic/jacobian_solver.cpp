#include "core/harmonic/jacobian_solver.hpp"

#include <chrono>

namespace pliant::harmonic {

namespace {

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void JacobianSolver::linearize(const Vector& z, double omega, Vector& h, Vector* frequencyDerivative,
                               const StressSource* stresses) {
  problem_.linearize(z, omega, h, &jacobian_, frequencyDerivative, stresses);
}

bool JacobianSolver::factorize() {
  const auto begin = std::chrono::steady_clock::now();
  if (!factorization_ || factorization_.use_count() > 1) factorization_ = std::make_shared<math::SparseFactorization>();
  const bool regular = factorization_->factorize(jacobian_);
  ++problem_.cost().factorizations;
  problem_.cost().factorizationSeconds += secondsSince(begin);
  return regular;
}

Matrix JacobianSolver::solve(const Matrix& b) const {
  const auto begin = std::chrono::steady_clock::now();
  Matrix x = factorization_->solve(b);
  problem_.cost().solves += static_cast<int>(b.cols());
  problem_.cost().solveSeconds += secondsSince(begin);
  return x;
}

}  // namespace pliant::harmonic
