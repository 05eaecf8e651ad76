#pragma once

#include <Eigen/Core>
#include <array>

namespace pliant::interlock {

/// z = ½ [m (x² + y²) + a (x² - y²) + 2 b x y] with the curvatures (mean, deviator, twist) = (m, a, b) [1/m]: principal
/// curvatures k_1 in the direction θ and k_2 across it are m = (k_1 + k_2)/2, (a, b) = (k_1 - k_2)/2 (cos 2θ, sin 2θ).
/// In the terms of thesis 4.3.2, z = A x² + B y² + C x y: A = (m + a)/2, B = (m - a)/2, C = b.
struct Paraboloid {
  Eigen::Vector3d curvature = Eigen::Vector3d::Zero();

  double height(double x, double y) const { return ofCurvature(x, y).dot(curvature); }
  /// By x and y.
  Eigen::Vector2d slope(double x, double y) const { return second() * Eigen::Vector2d(x, y); }
  Eigen::Matrix2d second() const {
    const auto& [m, a, b] = std::array<double, 3>{curvature[0], curvature[1], curvature[2]};
    return (Eigen::Matrix2d() << m + a, b, b, m - a).finished();
  }
  /// Derivative of the height by the curvatures [m²].
  static Eigen::Vector3d ofCurvature(double x, double y) {
    return {0.5 * (x * x + y * y), 0.5 * (x * x - y * y), x * y};
  }
  /// Derivatives of these by x and y in the columns [m].
  static Eigen::Matrix<double, 3, 2> slopeOfCurvature(double x, double y) {
    return (Eigen::Matrix<double, 3, 2>() << x, y, x, -y, y, x).finished();
  }
};

}  // namespace pliant::interlock
