#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "core/harmonic/response_point.hpp"

namespace pliant::test {

/// x'' + c x' + f(x) = p(ωt) with unit masses by time integration (Runge-Kutta of order 4, with the variational
/// equations): nothing here knows of harmonic balance or of Hill's method.
struct OscillatorOracle {
  double damping = 0;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> force;      ///< f
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> stiffness;  ///< ∂f/∂x
  std::function<Eigen::VectorXd(double)> drive;                      ///< p of τ
  int steps = 2000;                                                  ///< a period

  /// (x, x') and, in the columns beyond the first, its derivatives by the start, after a period from τ = 0.
  Eigen::MatrixXd period(const Eigen::MatrixXd& start, double omega) const {
    const Eigen::Index n = start.rows() / 2;
    const auto rate = [&](double t, const Eigen::MatrixXd& y) {
      Eigen::MatrixXd r(y.rows(), y.cols());
      const Eigen::VectorXd x = y.col(0).head(n);
      r.topRows(n) = y.bottomRows(n);
      r.bottomRows(n) = -damping * y.bottomRows(n);
      r.col(0).tail(n) += drive(omega * t) - force(x);
      if (y.cols() > 1) r.bottomRightCorner(n, y.cols() - 1) -= stiffness(x) * y.topRightCorner(n, y.cols() - 1);
      return r;
    };
    Eigen::MatrixXd y = start;
    const double h = 2 * std::numbers::pi / omega / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      const Eigen::MatrixXd k1 = rate(t, y);
      const Eigen::MatrixXd k2 = rate(t + h / 2, y + h / 2 * k1);
      const Eigen::MatrixXd k3 = rate(t + h / 2, y + h / 2 * k2);
      const Eigen::MatrixXd k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
  }

  /// Floquet multipliers of the motion through `start` = (x, x') at τ = 0, by falling modulus.
  std::vector<std::complex<double>> multipliers(const Eigen::VectorXd& start, double omega) const {
    Eigen::MatrixXd y(start.size(), start.size() + 1);
    y << start, Eigen::MatrixXd::Identity(start.size(), start.size());
    const Eigen::VectorXcd values = Eigen::MatrixXd(period(y, omega).rightCols(start.size())).eigenvalues();
    std::vector<std::complex<double>> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end(), [](auto a, auto b) { return std::abs(a) > std::abs(b); });
    return sorted;
  }

  /// The start of the periodic motion near `start`, by shooting: a series cut at some harmonic is not exactly on it.
  Eigen::VectorXd orbit(Eigen::VectorXd start, double omega) const {
    const Eigen::Index n = start.size();
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    for (int iteration = 0; iteration < 10; ++iteration) {
      Eigen::MatrixXd y(n, n + 1);
      y << start, identity;
      const Eigen::MatrixXd end = period(y, omega);
      const Eigen::VectorXd gap = end.col(0) - start;
      const Eigen::MatrixXd slope = end.rightCols(n) - identity;
      start -= slope.partialPivLu().solve(gap);
      if (gap.norm() < 1e-11) break;
    }
    return start;
  }

  int unstableCount(const Eigen::VectorXd& start, double omega) const {
    int count = 0;
    for (const auto multiplier : multipliers(start, omega)) count += std::abs(multiplier) > 1;
    return count;
  }
};

/// (x, dx/dt) at τ = 0 of a series with coefficients z of some coordinates.
inline Eigen::VectorXd startOfSeries(const Eigen::VectorXd& z, int harmonics, double omega) {
  const Eigen::Index width = 2 * harmonics + 1;
  const Eigen::Index n = z.size() / width;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    start[i] = z[i * width];
    for (int k = 1; k <= harmonics; ++k) {
      start[i] += z[i * width + 2 * k];
      start[n + i] += omega * k * z[i * width + 2 * k - 1];
    }
  }
  return start;
}

/// Largest distance of a multiplier of `found` from the nearest of `expected`.
inline double distanceBetween(const std::vector<std::complex<double>>& found,
                              const std::vector<std::complex<double>>& expected) {
  double worst = 0;
  for (const auto multiplier : found) {
    double nearest = 1e300;
    for (const auto other : expected) nearest = std::min(nearest, std::abs(multiplier - other));
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace pliant::test
