#include "core/harmonic/jacobian_solver.hpp"

#include "core/base/stopwatch.hpp"

namespace pliant::harmonic {

void JacobianSolver::linearize(const Vector& z, double omega, Vector& h, Vector* frequencyDerivative,
                               const StressSource* stresses) {
  problem_.linearize(z, omega, h, &jacobian_, frequencyDerivative, stresses);
}

bool JacobianSolver::factorize() {
  const base::Stopwatch watch;
  if (!factorization_ || factorization_.use_count() > 1) factorization_ = std::make_shared<math::SparseFactorization>();
  const bool regular = factorization_->factorize(jacobian_);
  ++problem_.cost().factorizations;
  problem_.cost().factorizationSeconds += watch.seconds();
  return regular;
}

Matrix JacobianSolver::solve(const Matrix& b) const {
  const base::Stopwatch watch;
  Matrix x = problem_.expanded(factorization_->solve(problem_.restricted(b)));
  countSolves(b.cols(), watch.seconds());
  return x;
}

Matrix JacobianSolver::solveRoughly(const Matrix& b) const {
  const base::Stopwatch watch;
  Matrix x = problem_.expanded(factorization_->solveRoughly(problem_.restricted(b)));
  countSolves(b.cols(), watch.seconds());
  return x;
}

void JacobianSolver::countSolves(Eigen::Index count, double seconds) const {
  problem_.cost().solves += static_cast<int>(count);
  problem_.cost().solveSeconds += seconds;
}

}  // namespace pliant::harmonic
