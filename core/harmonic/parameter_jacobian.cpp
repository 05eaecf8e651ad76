#include "core/harmonic/parameter_jacobian.hpp"

#include "core/mechanics/stiffness_factor.hpp"

namespace pliant::harmonic {

using mechanics::ElasticDerivative;

ParameterJacobian::ParameterJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega,
                                     std::vector<int> parameters)
    : problem_(problem),
      omega_(omega / problem.drivePeriods()),
      parameters_(std::move(parameters)),
      positions_(problem.trajectories(z)) {
  std::vector<Vector> columns;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto derivative = derivativeOf(i);
    const bool few = dynamic_cast<const ElasticDerivative*>(derivative.get());
    columnOf_.push_back(few ? -1 : static_cast<int>(columns.size()));
    if (!few) columns.push_back(problem.parameterDerivative(z, omega, *derivative));
  }
  columns_.resize(problem.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) columns_.col(static_cast<Eigen::Index>(c)) = columns[c];
}

std::unique_ptr<mechanics::ModelDerivative> ParameterJacobian::derivativeOf(std::size_t i) const {
  const Model& model = problem_.model();
  return model.parameters.at(static_cast<std::size_t>(parameters_[i]))->derivative(model);
}

Vector ParameterJacobian::times(const Vector& change) const {
  const Model& model = problem_.model();
  const math::HarmonicBasis& basis = problem_.basis();
  Vector product = Vector::Zero(problem_.size());
  Matrix forces = Matrix::Zero(positions_.rows(), positions_.cols());
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const double share = change[static_cast<Eigen::Index>(i)];
    if (share == 0) continue;
    if (columnOf_[i] >= 0) {
      product += share * columns_.col(columnOf_[i]);
      continue;
    }
    const auto derivative = derivativeOf(i);
    const auto& elastic = static_cast<const ElasticDerivative&>(*derivative);
    const Matrix gradient = elastic.coordinateGradient(positions_);
    for (std::size_t c = 0; c < elastic.coordinates().size(); ++c)
      forces.col(elastic.coordinates()[c]) += share * gradient.col(static_cast<Eigen::Index>(c));
  }
  if (columns_.cols() == static_cast<Eigen::Index>(parameters_.size())) return product;
  const Matrix elastic = basis.analysis() * forces(Eigen::all, model.dofs.freeCoordinates);
  return product +
         problem_.withoutLeftOut((elastic + model.stiffnessDamping * omega_ * basis.derivative(elastic)).reshaped());
}

Vector ParameterJacobian::transposedTimes(const Vector& adjoint) const {
  // λᵀ (1 + D_β ω d) analysis g = Σ over samples of (virtual displacement) · g.
  const Model& model = problem_.model();
  const math::HarmonicBasis& basis = problem_.basis();
  const Eigen::Map<const Matrix> lambda(adjoint.data(), basis.size(), model.dofs.freeCount());
  const Matrix virtualMotion = lambda - model.stiffnessDamping * omega_ * basis.derivative(lambda);
  Matrix displacements = Matrix::Zero(positions_.rows(), positions_.cols());
  displacements(Eigen::all, model.dofs.freeCoordinates) = basis.analysis().transpose() * virtualMotion;
  Vector products(static_cast<Eigen::Index>(parameters_.size()));
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    double& work = products[static_cast<Eigen::Index>(i)];
    if (columnOf_[i] >= 0) {
      work = adjoint.dot(columns_.col(columnOf_[i]));
      continue;
    }
    const auto derivative = derivativeOf(i);
    const auto& elastic = static_cast<const ElasticDerivative&>(*derivative);
    const Matrix gradient = elastic.coordinateGradient(positions_);
    work = 0;
    for (std::size_t c = 0; c < elastic.coordinates().size(); ++c)
      work += gradient.col(static_cast<Eigen::Index>(c)).dot(displacements.col(elastic.coordinates()[c]));
  }
  return products;
}

}  // namespace pliant::harmonic
