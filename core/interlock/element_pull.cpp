#include "core/interlock/element_pull.hpp"

#include <Eigen/Geometry>

namespace pliant::interlock {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d placeOf(const UnitCell& cell, const CellState& state, const ElementPull& pull) {
  Vector3d place = state.positions.col(pull.element) + state.rotations[pull.element] * pull.arm;
  place.head<2>() += stretchOf(state.strain) * (cell.lattice * pull.shift);
  return place;
}

double energyOf(const UnitCell& cell, const CellState& state, const ElementPull& pull, const Vector3d& before) {
  const Vector3d place = placeOf(cell, state, pull);
  const double distance = (place - pull.target).norm();
  const bool bounded = pull.spring * distance > pull.strongest;
  const double spring = bounded ? pull.strongest * (distance - 0.5 * pull.strongest / pull.spring)
                                : 0.5 * pull.spring * distance * distance;
  return spring - pull.force.dot(place - before);
}

void addDerivatives(const UnitCell& cell, const CellState& state, const ElementPull& pull, Eigen::VectorXd& gradient,
                    Eigen::MatrixXd* hessian) {
  const Eigen::Index first = 6 * pull.element, strain = gradient.size() - 3;
  const Vector3d arm = state.rotations[pull.element] * pull.arm;
  // Of the place by translation, rotation and strain.
  Eigen::Matrix<double, 3, 9> motion = Eigen::Matrix<double, 3, 9>::Zero();
  motion.leftCols<3>().setIdentity();
  motion.middleCols<3>(3) << 0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0], 0;  // ω x arm
  for (int k = 0; k < 3; ++k)
    motion.col(6 + k).head<2>() = stretchBasis()[static_cast<std::size_t>(k)] * (cell.lattice * pull.shift);

  const Vector3d away = placeOf(cell, state, pull) - pull.target;
  const double distance = away.norm();
  const bool bounded = pull.spring * distance > pull.strongest;
  const double stiffness = bounded ? pull.strongest / distance : pull.spring;
  const Vector3d slope = stiffness * away - pull.force;
  const Eigen::Matrix<double, 9, 1> local = motion.transpose() * slope;
  gradient.segment<6>(first) += local.head<6>();
  gradient.tail<3>() += local.tail<3>();
  if (!hessian) return;

  Matrix3d curvature = stiffness * Matrix3d::Identity();
  if (bounded) curvature -= stiffness * (away / distance) * (away / distance).transpose();
  Eigen::Matrix<double, 9, 9> second = motion.transpose() * curvature * motion;
  // The arm turned by ω moves by ½ ω x (ω x arm) to second order.
  second.block<3, 3>(3, 3) +=
      0.5 * (slope * arm.transpose() + arm * slope.transpose()) - slope.dot(arm) * Matrix3d::Identity();
  hessian->block<6, 6>(first, first) += second.topLeftCorner<6, 6>();
  hessian->block<6, 3>(first, strain) += second.topRightCorner<6, 3>();
  hessian->block<3, 6>(strain, first) += second.bottomLeftCorner<3, 6>();
  hessian->block<3, 3>(strain, strain) += second.bottomRightCorner<3, 3>();
}

}  // namespace pliant::interlock
