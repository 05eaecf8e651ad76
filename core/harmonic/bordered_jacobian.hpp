#pragma once

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// [∂h/∂z ∂h/∂ω; nᵀ] at one point of a response curve, with its factors: regular at folds as well, since the border n
/// is the curve's tangent. Vectors here are (z, ω) or (h, n·u), of size() + 1, coefficients that are left out being 0.
///
/// The tangent has length 1 in the measure (Δz / the swing, Δω / ω), in which n is dual to it: n · tangent = 1.
class BorderedJacobian {
 public:
  /// `border`: the tangent of a point nearby, to which n is dual instead; saves a factorisation. For `stresses` see
  /// HarmonicBalanceProblem::linearize.
  BorderedJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega, const Vector* border = nullptr,
                   const StressSource* stresses = nullptr);

  /// False where two curves cross or the motion does not swing: nothing else may be asked then.
  bool regular() const { return regular_; }
  const Vector& tangent() const { return tangent_; }
  /// h there.
  const Vector& residual() const { return residual_; }
  /// Of a difference of points, in the measure of the tangent.
  double length(const Vector& difference) const { return difference.cwiseQuotient(scale_).norm(); }
  /// Solves with the matrix, and with its transpose.
  Vector solve(const Vector& right) const;
  Matrix solveTransposed(const Matrix& right) const;

 private:
  bool factorize(const SparseMatrix& jacobian, const Vector& frequencyDerivative, const Vector& border);
  Matrix restricted(const Matrix& x) const;
  Matrix expanded(const Matrix& x) const;

  const HarmonicBalanceProblem& problem_;
  math::SparseFactorization factors_;
  Vector tangent_, residual_;
  Vector scale_;
  bool regular_ = false;
};

}  // namespace pliant::harmonic
