#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "core/mechanics/mechanism.hpp"

namespace pliant::mechanics {

/// One step of the classical Runge-Kutta method for dy/dt = rate(t, y).
template <class Rate, class State>
State rungeKutta(const Rate& rate, const State& y, double t, double step) {
  const State a = rate(t, y);
  const State b = rate(t + step / 2, State(y + step / 2 * a));
  const State c = rate(t + step / 2, State(y + step / 2 * b));
  const State d = rate(t + step, State(y + step * c));
  return y + step / 6 * (a + 2 * b + 2 * c + d);
}

/// Two links with point masses at their ends, hanging from a pivot that moves sideways by swing cos(ω t); every mass is
/// damped by damping * m * velocity. Angles [rad] from straight down, counter-clockwise.
struct DoublePendulum {
  using State = Eigen::Vector4d;  ///< two angles, two angular velocities

  std::array<double, 2> length, mass;
  double gravity = 0, damping = 0, swing = 0, omega = 0;

  /// The equations of motion in the angles: Σ Jᵢᵀ (mᵢ aᵢ - fᵢ) = 0 with the velocities vᵢ = pivot's + Jᵢ θ'.
  State operator()(double t, const State& y) const {
    Eigen::Matrix2d inertia = Eigen::Matrix2d::Zero(), jacobian = Eigen::Matrix2d::Zero(), rate = jacobian;
    Eigen::Vector2d torque = Eigen::Vector2d::Zero();
    const Eigen::Vector2d pivotVelocity(-swing * omega * std::sin(omega * t), 0);
    const Eigen::Vector2d pivotAcceleration(-swing * omega * omega * std::cos(omega * t), 0);
    for (int i = 0; i < 2; ++i) {
      jacobian.col(i) << length[i] * std::cos(y[i]), length[i] * std::sin(y[i]);
      rate.col(i) << -length[i] * std::sin(y[i]) * y[2 + i], length[i] * std::cos(y[i]) * y[2 + i];
      const Eigen::Vector2d velocity = pivotVelocity + jacobian * y.tail<2>();
      const Eigen::Vector2d known = pivotAcceleration + rate * y.tail<2>();
      const Eigen::Vector2d force = mass[i] * (Eigen::Vector2d(0, -gravity) - damping * velocity);
      inertia += mass[i] * jacobian.transpose() * jacobian;
      torque += jacobian.transpose() * (force - mass[i] * known);
    }
    State result;
    result << y.tail<2>(), inertia.ldlt().solve(torque);
    return result;
  }

  /// Pivot, elbow and end [m].
  Vector positions(const State& y, double t) const {
    Vector x(6);
    x.head<2>() << swing * std::cos(omega * t), 0;
    for (int i = 0; i < 2; ++i)
      x.segment<2>(2 * i + 2) = x.segment<2>(2 * i) + length[i] * Eigen::Vector2d(std::sin(y[i]), -std::cos(y[i]));
    return x;
  }

  /// Of rigid links, hanging at rest, its pivot locked.
  Model model(double stiffness) const {
    Model result;
    result.dimension = 2;
    result.restPositions = (Vector(6) << 0, 0, 0, -length[0], 0, -length[0] - length[1]).finished();
    for (const int joint : {0, 1})
      for (const auto& energy : makeRigidBar(2, result.restPositions, {joint, joint + 1}, stiffness))
        result.energies.push_back(energy);
    for (const int i : {0, 1}) result.pointMasses.push_back({"mass " + std::to_string(i), {i + 1}, mass[i], 0, 0});
    result.gravity = Eigen::Vector2d(0, -gravity);
    result.massDamping = damping;
    result.lockedCoordinates = {1, 1, 0, 0, 0, 0};
    result.finish();
    return result;
  }
};

}  // namespace pliant::mechanics
