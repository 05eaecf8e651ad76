#pragma once

#include <memory>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// ∂h/∂z of a problem and its factors, kept together so that pattern and symbolic analysis are made once. All vectors
/// have the problem's size(), with zeros for what is left out. Counts what it does in `HarmonicBalanceProblem::cost`.
class JacobianSolver {
 public:
  explicit JacobianSolver(const HarmonicBalanceProblem& problem) : problem_(problem) {}

  /// Evaluates h, ∂h/∂z and (if not null) ∂h/∂ω; see HarmonicBalanceProblem::linearize.
  void linearize(const Vector& z, double omega, Vector& h, Vector* frequencyDerivative,
                 const StressSource* stresses = nullptr);
  /// Factorises ∂h/∂z as last linearised; false if it is singular.
  bool factorize();
  /// Solves with the factors last computed, which may belong to an earlier linearisation.
  Matrix solve(const Matrix& b) const;
  /// The same to about half the digits, for half the price.
  Matrix solveRoughly(const Matrix& b) const;
  /// ∂h/∂z, last linearised, times v.
  Vector multiply(const Vector& v) const { return problem_.expanded(jacobian_ * problem_.restricted(v)); }

  /// Of the problem's unknowns, like its factors.
  const SparseMatrix& jacobian() const { return jacobian_; }
  /// The factors; a later factorize() makes new ones if somebody still holds them.
  std::shared_ptr<const math::SparseFactorization> factorization() const { return factorization_; }

 private:
  void countSolves(Eigen::Index count, double seconds) const;

  const HarmonicBalanceProblem& problem_;
  SparseMatrix jacobian_;
  std::shared_ptr<math::SparseFactorization> factorization_;
};

}  // namespace pliant::harmonic
