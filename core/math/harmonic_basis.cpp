#include "core/math/harmonic_basis.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace pliant::math {

namespace {

/// Periods of the first frequency, of at most 32, after which the second one is nearest to the end of one of its own.
int nearestReturn(double ratio) {
  constexpr int most = 32;
  int best = most;
  double least = 1;
  for (int periods = 1; periods <= most; ++periods) {
    const double turns = periods * ratio;
    const double distance = std::abs(turns - std::round(turns));
    if (turns < 0.5 || distance >= least) continue;
    best = periods;
    least = distance;
  }
  return best;
}

}  // namespace

HarmonicBasis::HarmonicBasis(int harmonics, int samples) : HarmonicBasis(harmonics, samples, 0, 1) {}

HarmonicBasis HarmonicBasis::ofTwoFrequencies(int order, int samples, double ratio, int periods) {
  if (!(ratio > 0 && std::isfinite(ratio)))
    throw std::invalid_argument("the ratio of two frequencies is not above 0 and finite");
  if (periods < 0) throw std::invalid_argument("the number of periods is negative");
  return {order, samples, ratio, periods > 0 ? periods : nearestReturn(ratio)};
}

HarmonicBasis::HarmonicBasis(int order, int samples, double ratio, int periods)
    : order_(order), samplesOfPeriod_(samples), ratio_(ratio), periods_(periods) {
  if (order < 0) throw std::invalid_argument("the number of harmonics is negative");
  if (samples < 2 * order + 1) throw std::invalid_argument("a harmonic basis needs at least 2H + 1 samples");
  combinations_ = combinations(order);
  for (const auto& [first, second] : combinations_) rates_.push_back(periods * (first + second * ratio));
  const int count = this->samples();
  synthesis_.resize(count, size());
  synthesis_.col(0).setOnes();
  for (int k = 1; k <= harmonics(); ++k) {
    for (int i = 0; i < count; ++i) {
      const double phase = samplePhase(combination(k), i);
      synthesis_(i, 2 * k - 1) = std::sin(phase);
      synthesis_(i, 2 * k) = std::cos(phase);
    }
  }
  // The columns of Γ are orthogonal with squared norms N, N/2, N/2, ... (N all samples)
  analysis_ = synthesis_.transpose() * (2.0 / count);
  analysis_.row(0) *= 0.5;
}

std::vector<std::array<int, 2>> HarmonicBasis::combinations(int order) const {
  std::vector<std::array<int, 2>> all;
  for (int sum = 1; sum <= order; ++sum) {
    all.push_back({sum, 0});
    if (!hasTwoFrequencies()) continue;
    for (int second = 1; second < sum; ++second) {
      all.push_back({sum - second, second});
      all.push_back({sum - second, -second});
    }
    all.push_back({0, sum});
  }
  return all;
}

Phases HarmonicBasis::samplePhases(int sample) const {
  const auto angle = [&](int i) { return 2 * std::numbers::pi * i / samplesOfPeriod_; };
  if (!hasTwoFrequencies()) return angle(sample);
  return {angle(sample % samplesOfPeriod_), angle(sample / samplesOfPeriod_)};
}

double HarmonicBasis::samplePhase(std::array<int, 2> combination, int sample) const {
  // Reduced in integers, so that every sample of a combination is one of N exactly repeated values.
  const double step = 2 * std::numbers::pi / samplesOfPeriod_;
  const long long first = sample % samplesOfPeriod_, second = sample / samplesOfPeriod_;
  return step * static_cast<double>((combination[0] * first + combination[1] * second) % samplesOfPeriod_);
}

Eigen::MatrixXd HarmonicBasis::derivative(const Eigen::MatrixXd& coefficients) const {
  assert(coefficients.rows() == size());
  Eigen::MatrixXd result(coefficients.rows(), coefficients.cols());
  result.row(0).setZero();
  for (int k = 1; k <= harmonics(); ++k) {
    result.row(2 * k - 1) = -rate(k) * coefficients.row(2 * k);
    result.row(2 * k) = rate(k) * coefficients.row(2 * k - 1);
  }
  return result;
}

Eigen::MatrixXd HarmonicBasis::secondDerivative(const Eigen::MatrixXd& coefficients) const {
  assert(coefficients.rows() == size());
  Eigen::MatrixXd result(coefficients.rows(), coefficients.cols());
  result.row(0).setZero();
  for (int k = 1; k <= harmonics(); ++k) {
    const double factor = -rate(k) * rate(k);
    result.row(2 * k - 1) = factor * coefficients.row(2 * k - 1);
    result.row(2 * k) = factor * coefficients.row(2 * k);
  }
  return result;
}

Eigen::VectorXd HarmonicBasis::valuesAt(double tau) const {
  Eigen::VectorXd values(size());
  values[0] = 1;
  for (int k = 1; k <= harmonics(); ++k) {
    values[2 * k - 1] = std::sin(rate(k) * tau);
    values[2 * k] = std::cos(rate(k) * tau);
  }
  return values;
}

Eigen::VectorXd HarmonicBasis::valuesAtPhases(Phases phases) const {
  Eigen::VectorXd values(size());
  values[0] = 1;
  for (int k = 1; k <= harmonics(); ++k) {
    const auto [first, second] = combination(k);
    const double phase = first * phases.first + second * phases.second;
    values[2 * k - 1] = std::sin(phase);
    values[2 * k] = std::cos(phase);
  }
  return values;
}

}  // namespace pliant::math
