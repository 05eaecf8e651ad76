#include "core/mechanics/strain.hpp"

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

}  // namespace pliant::mechanics
