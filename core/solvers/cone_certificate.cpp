#include "core/solvers/cone_certificate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pliant::solvers {

void certify(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate, ConeSolution& solution) {
  using Map = Eigen::Matrix<double, 3, 2>;
  const Eigen::Matrix3Xd& x = solution.positions;
  std::vector<std::vector<Eigen::Matrix2d>> scalings;
  for (const MetricBounds& bounds : constraints.bounds) {
    scalings.emplace_back();
    for (const Eigen::Matrix2d& ellipse : bounds.ellipses)
      scalings.back().push_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(ellipse).operatorInverseSqrt());
  }
  const auto elementCount = static_cast<Eigen::Index>(constraints.elements.size());
  solution.multipliers.setZero(3, elementCount);
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, constraints.nodeCount);
  double supportGap = 0, complementarity = 0, largest = 0;
  Eigen::Index ellipse = 0, direction = 0;
  for (Eigen::Index e = 0; e < elementCount; ++e) {
    const ConeElement& element = constraints.elements[e];
    Map f = Map::Zero();
    for (int k = 0; k < 3; ++k) f += x.col(element.nodes[k]) * element.weights[k].transpose();
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const Eigen::Matrix2d& t : scalings[element.bounds]) {
      const auto m = solution.ellipseMultipliers.col(ellipse++);
      const Eigen::Matrix2d multiplier{{m[0], m[2]}, {m[2], m[1]}};
      const Map scaled = f * t, force = scaled * multiplier;
      const Eigen::Matrix2d metric = scaled.transpose() * scaled, square = force.transpose() * force;
      const double determinant = scaled.col(0).cross(scaled.col(1)).norm() * std::abs(multiplier.determinant());
      supportGap += std::sqrt(std::max(0.0, square.trace() + 2 * determinant)) - (force.transpose() * scaled).trace();
      complementarity += 0.5 * (multiplier * (Eigen::Matrix2d::Identity() - metric)).trace();
      largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(metric).eigenvalues()[1]);
      sum += t * multiplier * t;
    }
    for (const Eigen::Vector2d& v : constraints.bounds[element.bounds].directions) {
      const double multiplier = solution.directionMultipliers[direction++], squared = (f * v).squaredNorm();
      supportGap += multiplier * (std::sqrt(squared) - squared);
      complementarity += 0.5 * multiplier * (1 - squared);
      largest = std::max(largest, squared);
      sum += multiplier * v * v.transpose();
    }
    solution.multipliers.col(e) << sum(0, 0), sum(1, 1), sum(0, 1);
    for (int k = 0; k < 3; ++k) forces.col(element.nodes[k]) += f * (sum * element.weights[k]);
  }
  // With r = M (x - x̂) + Bᵀ(FΛ), D as in the header is P - ½ ‖r‖²_{M⁻¹} - Σ (‖F T Λ‖_* - ⟨F T Λ, F T⟩).
  double squaredResidual = 0, largestResidual = 0, largestGradient = 0;
  solution.objective = 0;
  for (int node = 0; node < constraints.nodeCount; ++node) {
    const Eigen::Vector3d offset = x.col(node) - candidate.col(node);
    solution.objective += 0.5 * constraints.masses[node] * offset.squaredNorm();
    if (constraints.fixed[node]) continue;
    const Eigen::Vector3d gradient = constraints.masses[node] * offset, residual = gradient + forces.col(node);
    squaredResidual += residual.squaredNorm() / constraints.masses[node];
    largestResidual = std::max(largestResidual, residual.cwiseAbs().maxCoeff());
    largestGradient = std::max(largestGradient, gradient.cwiseAbs().maxCoeff());
  }
  solution.bound = solution.objective - 0.5 * squaredResidual - supportGap;
  solution.violation = std::max(0.0, std::sqrt(largest) - 1);
  solution.dualResidual = largestGradient > 0 ? largestResidual / largestGradient : 0;
  solution.complementarity = solution.objective > 0 ? complementarity / solution.objective : 0;
}

Eigen::Matrix3Xd limitForces(const ConeConstraints& constraints, const ConeSolution& solution) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, constraints.nodeCount);
  for (std::size_t e = 0; e < constraints.elements.size(); ++e) {
    const ConeElement& element = constraints.elements[e];
    const auto m = solution.multipliers.col(static_cast<Eigen::Index>(e));
    const Eigen::Matrix2d multiplier{{m[0], m[2]}, {m[2], m[1]}};
    Eigen::Matrix<double, 3, 2> f = Eigen::Matrix<double, 3, 2>::Zero();
    for (int k = 0; k < 3; ++k) f += solution.positions.col(element.nodes[k]) * element.weights[k].transpose();
    for (int k = 0; k < 3; ++k) forces.col(element.nodes[k]) += f * (multiplier * element.weights[k]);
  }
  return forces;
}

double provenDistance(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate,
                      const ConeSolution& solution) {
  // D(t) = t a - ½ t² ‖BᵀU‖²_{M⁻¹} for the multiple t; certify tells D(1) = P - gap, whence a.
  ConeSolution checked = solution;
  certify(constraints, candidate, checked);
  const Eigen::Matrix3Xd forces = limitForces(constraints, checked);
  double squared = 0;
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (!constraints.fixed[node]) squared += forces.col(node).squaredNorm() / constraints.masses[node];
  const double gain = checked.bound + 0.5 * squared;
  return gain > 0 ? gain * gain / (2 * squared) : 0;
}

}  // namespace pliant::solvers
