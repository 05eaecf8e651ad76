#pragma once

#include "core/harmonic/jacobian_solver.hpp"

namespace pliant::harmonic {

/// Hill's quadratic eigenproblem of a periodic motion. A disturbance y(t) = e^{ρτ} p(τ), p periodic with coefficients
/// like z, obeys M ÿ + D_α M ẏ + (1 + D_β d/dt)(K(τ) y) = 0, so
///   (ρ² ω² M + ρ ω Δ + ∂h/∂z) p = 0,   Δ = (2 ω d + D_α) M + D_β K̂,
/// with d the derivative over τ and K̂ the stiffness in coefficients. The exponent ρ is per radian: the multiplier is
/// exp(2πρ), and the mass may be singular. `apply` is the inverse operator of its companion form,
///   (u, v) → (−(∂h/∂z)⁻¹ (ω Δ u + ω² M v), u),
/// whose eigenvalues are 1/ρ with v = p: exponents near zero come first.
class HillOperator {
 public:
  /// `solver` must be linearised (without extrapolated stresses) and factorised at the motion. `omega`: of the drive.
  HillOperator(const HarmonicBalanceProblem& problem, const JacobianSolver& solver, double omega);

  Eigen::Index size() const { return 2 * problem_.size(); }
  Vector apply(const Vector& uv) const;

 private:
  Vector stiffnessTimes(const Vector& p, const Matrix& massTimes) const;

  const HarmonicBalanceProblem& problem_;
  const JacobianSolver& solver_;
  const SparseMatrix& mass_;
  double omega_;  ///< of z
};

}  // namespace pliant::harmonic
