#include "core/harmonic/response_sensitivity.hpp"

#include <algorithm>

#include "core/harmonic/jacobian_solver.hpp"

namespace pliant::harmonic {

namespace {

/// J X = B by iterative refinement with factors of a matrix near J; false if it does not converge quickly.
bool refine(const SparseMatrix& jacobian, const math::SparseFactorization& factors, const Matrix& b, Matrix& x) {
  constexpr int maximumIterations = 10;
  constexpr double tolerance = 1e-12;
  x = factors.solve(b);
  double previous = 1;
  for (int iteration = 0; iteration < maximumIterations; ++iteration) {
    const Matrix correction = factors.solve(b - jacobian * x);
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

}  // namespace

ResponseSensitivity::ResponseSensitivity(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion)
    : z_(motion.z) {
  const auto& parameters = problem.model().parameters;
  Matrix rightSide(problem.size(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t p = 0; p < parameters.size(); ++p)
    rightSide.col(static_cast<Eigen::Index>(p)) = -problem.parameterDerivative(z_, motion.omega, *parameters[p]);
  derivative_ = Matrix::Zero(rightSide.rows(), rightSide.cols());
  if (parameters.empty()) return;

  JacobianSolver solver(problem);
  Vector h;
  solver.linearize(z_, motion.omega, h, nullptr);
  Matrix unknowns;
  if (motion.factorization &&
      refine(solver.jacobian(), *motion.factorization, problem.restricted(rightSide), unknowns)) {
    derivative_ = problem.expanded(unknowns);
    return;
  }
  regular_ = solver.factorize();
  derivative_ = regular_ ? solver.solve(rightSide) : Matrix::Zero(rightSide.rows(), rightSide.cols());
}

Vector ResponseSensitivity::predict(const Vector& parameterChange) const { return z_ + derivative_ * parameterChange; }

}  // namespace pliant::harmonic
