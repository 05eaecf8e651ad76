#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

namespace pliant::test {

/// x'' + 2 ζ x' + x + γ x³ = P cos Ωt by time integration (Runge-Kutta of order 4, with the variational equations), and
/// its periodic orbits by shooting: nothing here knows of harmonic balance.
struct DuffingOracle {
  double zeta;
  double gamma;
  double force;
  int steps = 4000;  ///< a period; the error of a period is about 1e-12

  struct Orbit {
    Eigen::Vector2d start;  ///< x and x' at t = 0
    double omega = 0;
    Eigen::Matrix2d monodromy;      ///< d(end)/d(start) over one period
    std::vector<double> positions;  ///< x at the times i T / steps
    bool stable() const { return monodromy.eigenvalues().cwiseAbs().maxCoeff() < 1; }
  };

  /// One period from `start`.
  Eigen::Vector2d integrate(const Eigen::Vector2d& start, double omega, Eigen::Matrix2d* monodromy,
                            std::vector<double>* positions) const {
    using State = Eigen::Matrix<double, 2, 3>;  // the solution, and its derivatives by the start
    const auto rate = [&](double t, const State& y) {
      State r;
      r.row(0) = y.row(1);
      r.row(1) = -2 * zeta * y.row(1) - (1 + 3 * gamma * y(0, 0) * y(0, 0)) * y.row(0);
      r(1, 0) = -2 * zeta * y(1, 0) - y(0, 0) - gamma * std::pow(y(0, 0), 3) + force * std::cos(omega * t);
      return r;
    };
    State y;
    y << start, Eigen::Matrix2d::Identity();
    const double h = 2 * std::numbers::pi / omega / steps;
    for (int i = 0; i < steps; ++i) {
      if (positions) positions->push_back(y(0, 0));
      const double t = i * h;
      const State k1 = rate(t, y);
      const State k2 = rate(t + h / 2, y + h / 2 * k1);
      const State k3 = rate(t + h / 2, y + h / 2 * k2);
      const State k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    if (monodromy) *monodromy = y.rightCols<2>();
    return y.col(0);
  }

  /// The periodic orbit near `start`.
  Orbit orbit(Eigen::Vector2d start, double omega) const {
    Orbit result;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Eigen::Vector2d gap = integrate(start, omega, &result.monodromy, nullptr) - start;
      if (gap.norm() < 1e-12) break;
      start -= (result.monodromy - Eigen::Matrix2d::Identity()).lu().solve(gap);
    }
    result.start = start;
    result.omega = omega;
    integrate(start, omega, &result.monodromy, &result.positions);
    return result;
  }

  /// The frequency near `omega` where an orbit near `start` folds: a multiplier of the orbit is 1.
  double foldFrequency(const Eigen::Vector2d& start, double omega) const {
    const auto defect = [&](const Eigen::Vector3d& u) {
      Eigen::Matrix2d monodromy;
      const Eigen::Vector2d end = integrate(u.head<2>(), u[2], &monodromy, nullptr);
      Eigen::Vector3d d;
      d << end - u.head<2>(), (monodromy - Eigen::Matrix2d::Identity()).determinant();
      return d;
    };
    Eigen::Vector3d u(start[0], start[1], omega);
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Eigen::Vector3d d = defect(u);
      Eigen::Matrix3d jacobian;
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(i);
        jacobian.col(i) = (defect(u + step) - defect(u - step)) / 2e-5;
      }
      const Eigen::Vector3d change = jacobian.lu().solve(d);
      u -= change;
      if (change.norm() < 1e-10) break;
    }
    return u[2];
  }
};

}  // namespace pliant::test
