#include "core/harmonic/parameter_jacobian.hpp"

#include "core/mechanics/family_parameter.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "core/mechanics/stiffness_factor.hpp"

namespace pliant::harmonic {

using mechanics::ElasticDerivative;

ParameterJacobian::ParameterJacobian(const HarmonicBalanceProblem& problem, const Vector& z, double omega,
                                     std::vector<int> parameters)
    : problem_(problem), z_(z), omega_(omega), parameters_(std::move(parameters)), positions_(problem.trajectories(z)) {
  columns_.resize(parameters_.size());
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const mechanics::DesignParameter& parameter = parameterAt(i);
    const bool joint = dynamic_cast<const mechanics::JointParameter*>(&parameter) != nullptr;
    kinds_.push_back(mechanics::factoredElement(parameter) ? Kind::elastic : joint ? Kind::joint : Kind::single);
    if (!joint) columns_[i] = problem_.parameterDerivative(z_, omega_, parameter);
  }
}

const mechanics::DesignParameter& ParameterJacobian::parameterAt(std::size_t i) const {
  return *problem_.model().parameters.at(static_cast<std::size_t>(parameters_[i]));
}

const Vector& ParameterJacobian::column(std::size_t i) const {
  if (columns_[i].size() == 0) columns_[i] = problem_.parameterDerivative(z_, omega_, parameterAt(i));
  return columns_[i];
}

Vector ParameterJacobian::times(const Vector& change) const {
  const Model& model = problem_.model();
  Vector product = Vector::Zero(problem_.size());
  Matrix forces;
  std::vector<std::shared_ptr<const mechanics::DesignParameter>> together;
  std::vector<double> shares;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const double share = change[static_cast<Eigen::Index>(i)];
    if (share == 0) continue;
    if (columns_[i].size() > 0) {
      product += share * columns_[i];
      continue;
    }
    if (kinds_[i] == Kind::joint) {
      together.push_back(model.parameters[static_cast<std::size_t>(parameters_[i])]);
      shares.push_back(share);
      continue;
    }
    if (forces.size() == 0) forces = Matrix::Zero(positions_.rows(), positions_.cols());
    const auto derivative = parameterAt(i).derivative(model);
    const auto& elastic = static_cast<const ElasticDerivative&>(*derivative);
    const Matrix gradient = elastic.coordinateGradient(positions_);
    for (std::size_t c = 0; c < elastic.coordinates().size(); ++c)
      forces.col(elastic.coordinates()[c]) += share * gradient.col(static_cast<Eigen::Index>(c));
  }
  if (!together.empty()) {
    const Eigen::Map<const Vector> direction(shares.data(), static_cast<Eigen::Index>(shares.size()));
    product += problem_.parameterDerivative(z_, omega_, *mechanics::derivativeAlong(model, together, direction));
  }
  if (forces.size() == 0) return product;
  const math::HarmonicBasis& basis = problem_.basis();
  const Matrix elastic = basis.analysis() * forces(Eigen::all, model.dofs.freeCoordinates);
  return product + problem_.withoutLeftOut(
                       (elastic + model.stiffnessDamping * ownOmega() * basis.derivative(elastic)).reshaped());
}

Vector ParameterJacobian::transposedTimes(const Vector& adjoint) const {
  // λᵀ (1 + D_β ω d) analysis g = Σ over samples of (virtual displacement) · g.
  const Model& model = problem_.model();
  const math::HarmonicBasis& basis = problem_.basis();
  const Eigen::Map<const Matrix> lambda(adjoint.data(), basis.size(), model.dofs.freeCount());
  const Matrix virtualMotion = lambda - model.stiffnessDamping * ownOmega() * basis.derivative(lambda);
  Matrix displacements = Matrix::Zero(positions_.rows(), positions_.cols());
  displacements(Eigen::all, model.dofs.freeCoordinates) = basis.analysis().transpose() * virtualMotion;
  Vector products(static_cast<Eigen::Index>(parameters_.size()));
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    double& work = products[static_cast<Eigen::Index>(i)];
    if (kinds_[i] != Kind::elastic) {
      work = adjoint.dot(column(i));
      continue;
    }
    const auto derivative = parameterAt(i).derivative(model);
    const auto& elastic = static_cast<const ElasticDerivative&>(*derivative);
    const Matrix gradient = elastic.coordinateGradient(positions_);
    work = 0;
    for (std::size_t c = 0; c < elastic.coordinates().size(); ++c)
      work += gradient.col(static_cast<Eigen::Index>(c)).dot(displacements.col(elastic.coordinates()[c]));
  }
  return products;
}

}  // namespace pliant::harmonic
