#include "core/mechanics/strain.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pliant::mechanics {

namespace {

/// The metric (e₁·e₁, e₂·e₂, e₁·e₂) of a triangle's edges.
std::array<double, 3> edgeMetric(int dimension, const double* x, const std::array<int, 3>& triangle) {
  std::array<double, 3> metric{};
  for (int axis = 0; axis < dimension; ++axis) {
    const double origin = x[triangle[0] * dimension + axis];
    const double e1 = x[triangle[1] * dimension + axis] - origin, e2 = x[triangle[2] * dimension + axis] - origin;
    metric[0] += e1 * e1;
    metric[1] += e2 * e2;
    metric[2] += e1 * e2;
  }
  return metric;
}

Eigen::Matrix3d tetrahedronEdges(const Vector& x, const std::array<int, 4>& tetrahedron) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.segment<3>(3 * tetrahedron[k + 1]) - x.segment<3>(3 * tetrahedron[0]);
  return edges;
}

}  // namespace

Vector principalStretches(int dimension, const Vector& restPositions, const Vector& positions,
                          const Triangles& triangles) {
  Vector stretches(static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [r11, r22, r12] = edgeMetric(dimension, restPositions.data(), triangles[t]);
    const auto [a11, a22, a12] = edgeMetric(dimension, positions.data(), triangles[t]);
    // The rest edges in the triangle's frame are (p, 0) and (q, r); C = FᵀF follows from the metrics.
    const double p = std::sqrt(r11), q = r12 / p, squaredR = r22 - q * q;
    const double c11 = a11 / r11;
    const double c12 = (a12 - q * p * c11) / p;  // times r
    const double c22 = (a22 - 2 * q * c12 - q * q * c11) / squaredR;
    const double difference = 0.5 * (c11 - c22);
    const double squared = 0.5 * (c11 + c22) + std::sqrt(difference * difference + c12 * c12 / squaredR);
    stretches[static_cast<Eigen::Index>(t)] = std::sqrt(squared);
  }
  return stretches;
}

Vector principalStretches(const Vector& restPositions, const Vector& positions, const Tetrahedra& tetrahedra) {
  Vector stretches(static_cast<Eigen::Index>(tetrahedra.size()));
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const Eigen::Matrix3d gradient =
        tetrahedronEdges(positions, tetrahedra[t]) * tetrahedronEdges(restPositions, tetrahedra[t]).inverse();
    // In closed form, since this runs for every sample of every point of a curve.
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares;
    squares.computeDirect(gradient.transpose() * gradient, Eigen::EigenvaluesOnly);
    stretches[static_cast<Eigen::Index>(t)] = std::sqrt(std::max(0.0, squares.eigenvalues()[2]));
  }
  return stretches;
}

std::optional<double> largestStrain(const Model& model, const Vector& positions) {
  if (model.dimension == 1) return std::nullopt;
  std::optional<double> largest;
  const auto include = [&](const Vector& stretches) {
    if (stretches.size() > 0) largest = std::max(largest.value_or(-1), stretches.maxCoeff() - 1);
  };
  for (const DisplayPart& part : model.parts) {
    include(principalStretches(model.dimension, model.restPositions, positions, part.triangles));
    if (model.dimension == 3) include(principalStretches(model.restPositions, positions, part.tetrahedra));
  }
  return largest;
}

}  // namespace pliant::mechanics
