#pragma once

#include <Eigen/Core>

namespace pliant::solvers {

struct QuadraticProgramResult {
  Eigen::VectorXd x;
  Eigen::VectorXd multipliers;  ///< of the constraints, not negative
  double residual = 0;          ///< largest of the optimality conditions, relative to the data
  int iterations = 0;
  bool converged = false;
};

/// Minimises ½ xᵀ H x + gᵀ x subject to A x <= b, for few dense variables; H symmetric and positive definite (n x n),
/// A (m x n). Mehrotra's predictor-corrector method (Nocedal and Wright 2006, section 16.6), which needs no feasible
/// start. Where no x satisfies the constraints it does not converge.
QuadraticProgramResult solveQuadraticProgram(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                             const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace pliant::solvers
