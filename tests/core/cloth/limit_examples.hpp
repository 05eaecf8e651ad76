#pragma once

#include <Eigen/Eigenvalues>
#include <numbers>

#include "core/cloth/stretch_limit.hpp"

namespace pliant::test {

using namespace cloth;

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180;

inline Eigen::Vector2d directionAt(double angle) { return {std::cos(angle), std::sin(angle)}; }

struct NamedCurve {
  const char* name;
  std::vector<DirectionLimit> points;
};

inline const std::vector<NamedCurve>& curves() {
  static const std::vector<NamedCurve> list = [] {
    std::vector<NamedCurve> curves = {
        {"woven", {{0, 1.02}, {45, 1.2}, {90, 1.03}, {135, 1.2}}},
        {"twill", {{0, 1.02}, {30, 1.06}, {45, 1.12}, {60, 1.18}, {90, 1.03}, {135, 1.25}}},
        {"knit", {{0, 1.5}, {45, 1.6}, {90, 1.9}, {135, 1.6}}},
        {"tight in one direction", {{0, 1.001}, {10, 1.3}, {170, 1.3}}},
        {"sharp notch", {{0, 1.2}, {29, 1.2}, {30, 1.01}, {31, 1.2}, {90, 1.2}}},
        {"notch between samples", {{0, 1.2}, {29.98, 1.2}, {30.01, 1.05}, {30.04, 1.2}}}};
    for (NamedCurve& curve : curves)
      for (DirectionLimit& point : curve.points) point.angle *= degree;
    return curves;
  }();
  return list;
}

/// Directions at which a limit is looked at: even ones, and as many again about each point of a curve.
inline std::vector<double> fineAngles(const StretchLimit& limit, int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(pi * i / count);
  if (const auto* curve = std::get_if<LimitCurve>(&limit))
    for (const DirectionLimit& point : curve->points())
      for (int i = -100; i <= 100; ++i) angles.push_back(point.angle + 0.0005 * degree * i);
  return angles;
}

struct Grid {
  Grid(const StretchLimit& limit, int count) {
    for (const double angle : fineAngles(limit, count)) {
      directions.push_back(directionAt(angle));
      limits.push_back(stretchAt(limit, angle));
    }
  }
  /// The largest stretch / limit - 1.
  double excess(const Eigen::Matrix2d& metric) const {
    double largest = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
      largest = std::max(largest, directions[i].dot(metric * directions[i]) / (limits[i] * limits[i]));
    return std::sqrt(largest) - 1;
  }
  std::vector<Eigen::Vector2d> directions;
  std::vector<double> limits;
};

/// The largest multiple of a C that some constraints allow.
inline double largestMultiple(const LimitConstraints& constraints, const Eigen::Matrix2d& metric) {
  double most = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix2d& s : constraints.ellipses) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(metric, s);
    most = std::min(most, 1 / solver.eigenvalues()[1]);
  }
  for (const auto& [angle, stretch] : constraints.directions) {
    const Eigen::Vector2d d = directionAt(angle);
    const double squared = d.dot(metric * d);  // rounding may bring it below 0
    if (squared > 1e-12 * metric.trace()) most = std::min(most, stretch * stretch / squared);
  }
  return most;
}

/// A C of trace 2 by the two numbers that it has left: positive semidefinite if the first is from 0 to 1.
inline Eigen::Matrix2d metricOf(double eccentricity, double doubled) {
  const double c = eccentricity * std::cos(doubled), s = eccentricity * std::sin(doubled);
  return Eigen::Matrix2d{{1 + c, s}, {s, 1 - c}};
}

}  // namespace pliant::test
