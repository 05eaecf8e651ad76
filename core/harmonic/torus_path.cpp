#include "core/harmonic/torus_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant::harmonic {

namespace {

using std::numbers::pi;

/// Points of a period of each frequency. Where a path turns back on itself its speed has kinks, which leave a relative
/// error of (π / grid)² / 3 = 1e-5 at worst: where one of the frequencies hardly moves it.
int gridSize(const math::HarmonicBasis& basis) { return std::max(512, 16 * basis.order()); }

/// Coefficients over θ₁ at a fixed θ₂ from those of all combinations: (2H+1) x size.
Matrix sliceAt(const math::HarmonicBasis& basis, double second) {
  Matrix slice = Matrix::Zero(2 * basis.order() + 1, basis.size());
  slice(0, 0) = 1;
  for (int k = 1; k <= basis.harmonics(); ++k) {
    const auto [first, multiple] = basis.combination(k);
    const double c = std::cos(multiple * second), s = std::sin(multiple * second);
    const int sine = 2 * k - 1, cosine = 2 * k;
    if (first == 0) {
      slice(0, sine) = s;
      slice(0, cosine) = c;
      continue;
    }
    slice(2 * first - 1, sine) = c;
    slice(2 * first, sine) = s;
    slice(2 * first - 1, cosine) = -s;
    slice(2 * first, cosine) = c;
  }
  return slice;
}

}  // namespace

double meanPathLength(const math::HarmonicBasis& basis, const Matrix& coefficients, Matrix* gradient) {
  const int count = gridSize(basis);
  const math::HarmonicBasis firstPhase(basis.order(), count);
  const Matrix velocity = basis.derivative(coefficients);
  const double weight = 2 * pi / (basis.periods() * static_cast<double>(count) * count);
  double length = 0;
  Matrix byVelocity = Matrix::Zero(coefficients.rows(), coefficients.cols());
  for (int i = 0; i < count; ++i) {
    const Matrix slice = sliceAt(basis, 2 * pi * i / count);
    Matrix velocities = firstPhase.synthesis() * (slice * velocity);
    const Vector speeds = velocities.rowwise().norm();
    length += weight * speeds.sum();
    if (!gradient) continue;
    for (Eigen::Index row = 0; row < velocities.rows(); ++row)
      if (speeds[row] > 0) velocities.row(row) /= speeds[row];
    byVelocity += weight * (slice.transpose() * (firstPhase.synthesis().transpose() * velocities));
  }
  // The derivative operator is antisymmetric.
  if (gradient) *gradient = -basis.derivative(byVelocity);
  return length;
}

double largestDisplacement(const math::HarmonicBasis& basis, const Matrix& coefficients) {
  const int count = gridSize(basis);
  const math::HarmonicBasis firstPhase(basis.order(), count);
  Matrix fromMean = coefficients;
  fromMean.row(0).setZero();
  math::Phases farthest = 0;
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    const double second = 2 * pi * i / count;
    const Vector distances = (firstPhase.synthesis() * (sliceAt(basis, second) * fromMean)).rowwise().norm();
    Eigen::Index at = 0;
    if (const double distance = distances.maxCoeff(&at); distance > largest) {
      largest = distance;
      farthest = {2 * pi * static_cast<double>(at) / count, second};
    }
  }
  // From the best point of the grid to the farthest place near it.
  const auto distanceAt = [&](math::Phases phases) {
    return (fromMean.transpose() * basis.valuesAtPhases(phases)).norm();
  };
  constexpr double finest = 1e-9;
  for (double step = pi / count; largest > 0 && step > finest;) {
    const math::Phases before = farthest;
    for (const auto& [first, second] : {std::pair(step, 0.0), {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
      const math::Phases next{before.first + first, before.second + second};
      if (const double distance = distanceAt(next); distance > largest) {
        largest = distance;
        farthest = next;
      }
    }
    if (farthest.first == before.first && farthest.second == before.second) step /= 2;
  }
  return largest;
}

}  // namespace pliant::harmonic
