#include "core/harmonic/hill_operator.hpp"

namespace pliant::harmonic {

HillOperator::HillOperator(const HarmonicBalanceProblem& problem, const JacobianSolver& solver, double omega)
    : problem_(problem), solver_(solver), mass_(problem.freeMass()), omega_(omega / problem.drivePeriods()) {}

/// K̂ p, from ∂h/∂z p = (ω² d² + D_α ω d) M p + (1 + D_β ω d) K̂ p.
Vector HillOperator::stiffnessTimes(const Vector& p, const Matrix& massTimes) const {
  const Model& model = problem_.model();
  const math::HarmonicBasis& basis = problem_.basis();
  Matrix force = solver_.multiply(p).reshaped(massTimes.rows(), massTimes.cols());
  force -=
      omega_ * omega_ * basis.secondDerivative(massTimes) + model.massDamping * omega_ * basis.derivative(massTimes);
  for (int k = 1; k <= basis.harmonics(); ++k) {
    const double a = model.stiffnessDamping * omega_ * k;
    const Eigen::RowVectorXd sine = force.row(2 * k - 1);
    const Eigen::RowVectorXd cosine = force.row(2 * k);
    force.row(2 * k - 1) = (sine + a * cosine) / (1 + a * a);
    force.row(2 * k) = (cosine - a * sine) / (1 + a * a);
  }
  return force.reshaped();
}

Vector HillOperator::apply(const Vector& uv) const {
  const Model& model = problem_.model();
  const math::HarmonicBasis& basis = problem_.basis();
  const Eigen::Index n = problem_.size();
  const int free = model.dofs.freeCount();
  const Matrix massU = Eigen::Map<const Matrix>(uv.data(), basis.size(), free) * mass_;
  const Matrix massV = Eigen::Map<const Matrix>(uv.data() + n, basis.size(), free) * mass_;
  Vector right =
      (2 * omega_ * omega_ * basis.derivative(massU) + model.massDamping * omega_ * massU + omega_ * omega_ * massV)
          .reshaped();
  if (model.stiffnessDamping != 0) right += model.stiffnessDamping * omega_ * stiffnessTimes(uv.head(n), massU);
  Vector result(2 * n);
  result << -solver_.solveRoughly(right), problem_.withoutLeftOut(uv.head(n));
  return result;
}

}  // namespace pliant::harmonic
