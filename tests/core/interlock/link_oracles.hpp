#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// Points of a curve in space, at equal steps of its parameter (3 x count) [m].
inline Eigen::Matrix3Xd sampled(const ClosedCurve& curve, const Eigen::Matrix3d& rotation,
                                const Eigen::Vector3d& position, int count) {
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) points.col(i) = position + rotation * curve.placeAt(2 * std::numbers::pi * i / count);
  return points;
}

/// Gauss's double integral by the trapezoidal rule, which converges exponentially for smooth closed curves.
inline double gaussIntegral(const ClosedCurve& a, const ClosedCurve& b, const Eigen::Vector3d& offset, int count) {
  double sum = 0;
  const double step = 2 * std::numbers::pi / count;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const auto onA = a.at(i * step), onB = b.at(j * step);
      const Eigen::Vector3d between = onA.place + offset - onB.place;
      sum += between.dot(onA.tangent.cross(onB.tangent)) / std::pow(between.norm(), 3);
    }
  return sum * step * step / (4 * std::numbers::pi);
}

/// The smallest distance of two curves by trying all pairs of samples, and again more finely around the best [m].
inline double sampledDistance(const ClosedCurve& a, const ClosedCurve& b, const Eigen::Vector3d& offset,
                              int count = 360) {
  double bestS = 0, bestT = 0, best = 1e300, step = 2 * std::numbers::pi / count;
  const auto attempt = [&](double s, double t) {
    const double distance = (a.placeAt(s) + offset - b.placeAt(t)).norm();
    if (distance < best) best = distance, bestS = s, bestT = t;
  };
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) attempt(i * step, j * step);
  for (int level = 0; level < 14; ++level) {
    const double s = bestS, t = bestT;
    step *= 0.25;
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) attempt(s + i * step, t + j * step);
  }
  return best;
}

}  // namespace pliant::interlock
