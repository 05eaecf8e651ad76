#pragma once

#include <vector>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// ∂h/∂p at one motion, a column a parameter. Columns of parameters that change the elastic forces of a few coordinates
/// alone (mechanics::ElasticDerivative) are not formed, so that there may be as many as there are elements; those of
/// joint parameters only for `transposedTimes`, since one direction costs as little as one of them. One thread at a
/// time.
class ParameterJacobian {
 public:
  /// `parameters` are indices in `Model::parameters`. Keeps a reference to the problem.
  ParameterJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega, std::vector<int> parameters);

  /// ∂h/∂p Δp, of the size of h.
  Vector times(const Vector& change) const;
  /// (∂h/∂p)ᵀ λ, an entry a parameter.
  Vector transposedTimes(const Vector& adjoint) const;

 private:
  enum class Kind { single, joint, elastic };

  const mechanics::DesignParameter& parameterAt(std::size_t i) const;
  const Vector& column(std::size_t i) const;
  /// Of z's own period.
  double ownOmega() const { return omega_ / problem_.drivePeriods(); }

  const HarmonicBalanceProblem& problem_;
  Vector z_;
  double omega_;  ///< of the drive
  std::vector<int> parameters_;
  std::vector<Kind> kinds_;
  mutable std::vector<Vector> columns_;  ///< per parameter; empty: not formed
  Matrix positions_;                     ///< N x coordinates
};

}  // namespace pliant::harmonic
