#include "core/math/harmonic_basis.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace pliant::math {

HarmonicBasis::HarmonicBasis(int harmonics, int samples) : harmonics_(harmonics), samples_(samples) {
  if (harmonics < 0) throw std::invalid_argument("the number of harmonics is negative");
  if (samples < 2 * harmonics + 1) throw std::invalid_argument("a harmonic basis needs at least 2H + 1 samples");
  // The phase is reduced in integers, so that every sample of a harmonic is one of N exactly repeated values.
  const double step = 2 * std::numbers::pi / samples;
  synthesis_.resize(samples, size());
  synthesis_.col(0).setOnes();
  for (int k = 1; k <= harmonics; ++k) {
    for (int i = 0; i < samples; ++i) {
      const double phase = step * static_cast<double>(static_cast<long long>(k) * i % samples);
      synthesis_(i, 2 * k - 1) = std::sin(phase);
      synthesis_(i, 2 * k) = std::cos(phase);
    }
  }
  // The columns of Γ are orthogonal with squared norms N, N/2, N/2, ...
  analysis_ = synthesis_.transpose() * (2.0 / samples);
  analysis_.row(0) *= 0.5;
}

Eigen::MatrixXd HarmonicBasis::derivative(const Eigen::MatrixXd& coefficients) const {
  assert(coefficients.rows() == size());
  Eigen::MatrixXd result(coefficients.rows(), coefficients.cols());
  result.row(0).setZero();
  for (int k = 1; k <= harmonics_; ++k) {
    result.row(2 * k - 1) = -k * coefficients.row(2 * k);
    result.row(2 * k) = k * coefficients.row(2 * k - 1);
  }
  return result;
}

Eigen::MatrixXd HarmonicBasis::secondDerivative(const Eigen::MatrixXd& coefficients) const {
  assert(coefficients.rows() == size());
  Eigen::MatrixXd result(coefficients.rows(), coefficients.cols());
  result.row(0).setZero();
  for (int k = 1; k <= harmonics_; ++k) {
    const double factor = -static_cast<double>(k) * k;
    result.row(2 * k - 1) = factor * coefficients.row(2 * k - 1);
    result.row(2 * k) = factor * coefficients.row(2 * k);
  }
  return result;
}

Eigen::VectorXd HarmonicBasis::valuesAt(double tau) const {
  Eigen::VectorXd values(size());
  values[0] = 1;
  for (int k = 1; k <= harmonics_; ++k) {
    values[2 * k - 1] = std::sin(k * tau);
    values[2 * k] = std::cos(k * tau);
  }
  return values;
}

}  // namespace pliant::math
