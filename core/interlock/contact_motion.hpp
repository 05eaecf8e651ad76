#pragma once

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// How X_A - X_B of two places fixed to elements changes with 15 local coordinates: translation and rotation vector of
/// A, those of B, and the strain.
using ContactJacobian = Eigen::Matrix<double, 3, 15>;

inline Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0).finished();
}

/// Derivative by the strain of -F translation, for a lattice vector at rest [m].
inline Eigen::Matrix3d strainColumns(const Eigen::Vector2d& translation) {
  Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) columns.col(k).head<2>() = -stretchBasis()[k] * translation;
  return columns;
}

/// Arms from the elements' origins [m]; B's is moved by the lattice vector `translation`.
inline ContactJacobian contactJacobian(const Eigen::Vector3d& armA, const Eigen::Vector3d& armB,
                                       const Eigen::Vector2d& translation) {
  ContactJacobian jacobian;
  jacobian << Eigen::Matrix3d::Identity(), -crossMatrix(armA), -Eigen::Matrix3d::Identity(), crossMatrix(armB),
      strainColumns(translation);
  return jacobian;
}

/// Second derivative by the rotation vector of g · (exp[w] arm).
inline Eigen::Matrix3d rotationTerm(const Eigen::Vector3d& g, const Eigen::Vector3d& arm) {
  return 0.5 * (g * arm.transpose() + arm * g.transpose()) - g.dot(arm) * Eigen::Matrix3d::Identity();
}

}  // namespace pliant::interlock
