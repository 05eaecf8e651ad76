#pragma once

#include <vector>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// ∂h/∂p at one motion, a column a parameter. Columns of parameters that change the elastic forces of a few coordinates
/// alone (mechanics::ElasticDerivative) are not formed, so that there may be as many as there are elements.
class ParameterJacobian {
 public:
  /// `parameters` are indices in `Model::parameters`. Keeps a reference to the problem.
  ParameterJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega, std::vector<int> parameters);

  /// ∂h/∂p Δp, of the size of h.
  Vector times(const Vector& change) const;
  /// (∂h/∂p)ᵀ λ, an entry a parameter.
  Vector transposedTimes(const Vector& adjoint) const;

 private:
  std::unique_ptr<mechanics::ModelDerivative> derivativeOf(std::size_t i) const;

  const HarmonicBalanceProblem& problem_;
  double omega_;  ///< of z's own period
  std::vector<int> parameters_;
  std::vector<int> columnOf_;  ///< in columns_, or -1
  Matrix columns_;
  Matrix positions_;  ///< N x coordinates
};

}  // namespace pliant::harmonic
