#include "core/harmonic/path_length.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "core/harmonic/torus_path.hpp"

namespace pliant::harmonic {

namespace {

using std::numbers::pi;

/// Values and derivatives of the trigonometric polynomial through one node's coordinates.
class NodePath {
 public:
  NodePath(const math::HarmonicBasis& basis, Matrix coefficients) : basis_(basis), position_(std::move(coefficients)) {
    position_.row(0).setZero();
    velocity_ = basis_.derivative(position_);
    acceleration_ = basis_.secondDerivative(position_);
  }

  int harmonics() const { return basis_.harmonics(); }
  Vector velocity(double tau) const { return velocity_.transpose() * values(tau); }
  double squaredSpeed(double tau) const { return velocity(tau).squaredNorm(); }
  /// Half the derivative of the squared speed.
  double speedRate(double tau) const {
    const Vector basis = values(tau);
    return (velocity_.transpose() * basis).dot(acceleration_.transpose() * basis);
  }
  double squaredDistance(double tau) const { return fromMean(values(tau)).squaredNorm(); }
  /// Half the derivative of the squared distance from the mean position.
  double distanceRate(double tau) const {
    const Vector basis = values(tau);
    return fromMean(basis).dot(velocity_.transpose() * basis);
  }
  /// 1, sin τ, cos τ, ... by powers of exp(iτ).
  Vector values(double tau) const {
    Vector result(basis_.size());
    result[0] = 1;
    const std::complex<double> turn = std::polar(1.0, tau);
    std::complex<double> power = turn;
    for (int k = 1; k <= basis_.harmonics(); ++k, power *= turn) {
      result[2 * k - 1] = power.imag();
      result[2 * k] = power.real();
    }
    return result;
  }

 private:
  Vector fromMean(const Vector& basis) const { return position_.transpose() * basis; }

  const math::HarmonicBasis& basis_;
  Matrix position_;  ///< (2H+1) x coordinates, mean left out
  Matrix velocity_;  ///< of the derivatives over τ
  Matrix acceleration_;
};

/// Where a periodic function has its local minima, from its values on a grid and the sign of its derivative between.
std::vector<double> localMinima(int harmonics, const std::function<double(double)>& function,
                                const std::function<double(double)>& derivative) {
  const int count = std::max(64, 16 * harmonics);
  const double spacing = 2 * pi / count;
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = function(i * spacing);
  std::vector<double> minima;
  for (int i = 0; i < count; ++i) {
    if (!(values[i] < values[(i + count - 1) % count] && values[i] <= values[(i + 1) % count])) continue;
    double low = (i - 1) * spacing;
    double high = (i + 1) * spacing;
    for (int bisection = 0; bisection < 52; ++bisection) {
      const double middle = 0.5 * (low + high);
      (derivative(middle) < 0 ? low : high) = middle;
    }
    minima.push_back(0.5 * (low + high));
  }
  return minima;
}

/// Abscissas in (-1, 1) and weights of the double-exponential rule (Takahasi and Mori 1974), which does not mind the
/// kinks of the speed at the ends of an interval.
struct QuadratureRule {
  std::vector<double> abscissas, weights;
  QuadratureRule() {
    constexpr double step = 1.0 / 12;
    for (int i = -40; i <= 40; ++i) {
      const double inner = 0.5 * pi * std::sinh(i * step);
      abscissas.push_back(std::tanh(inner));
      weights.push_back(step * 0.5 * pi * std::cosh(i * step) / std::pow(std::cosh(inner), 2));
    }
  }
};

/// Calls `visit(τ, weight)` so that Σ weight f(τ) is the integral of f over a period, for functions that are smooth
/// between the instants of least speed.
void integrateOverPeriod(const NodePath& path, const std::function<void(double, double)>& visit) {
  static const QuadratureRule rule;
  const std::vector<double> turns = localMinima(
      path.harmonics(), [&](double tau) { return path.squaredSpeed(tau); },
      [&](double tau) { return path.speedRate(tau); });
  if (turns.empty()) {  // the speed is constant
    const int count = std::max(64, 16 * path.harmonics());
    for (int i = 0; i < count; ++i) visit(2 * pi * i / count, 2 * pi / count);
    return;
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const double end = i + 1 < turns.size() ? turns[i + 1] : turns[0] + 2 * pi;
    const double middle = 0.5 * (turns[i] + end);
    const double half = 0.5 * (end - turns[i]);
    for (std::size_t q = 0; q < rule.weights.size(); ++q)
      visit(middle + half * rule.abscissas[q], half * rule.weights[q]);
  }
}

}  // namespace

Matrix nodeCoefficients(const HarmonicBalanceProblem& problem, const Vector& z, int node) {
  const Eigen::Index width = problem.basis().size();
  const Matrix samples = problem.nodeTrajectory(z, node);
  Matrix coefficients(width, samples.cols());
  for (Eigen::Index axis = 0; axis < samples.cols(); ++axis) {
    const int f = problem.model().dofs.freeIndex[node * samples.cols() + axis];
    if (f >= 0) {
      coefficients.col(axis) = z.segment(f * width, width);
      continue;
    }
    // The first sample is taken off before the transform, so that a locked coordinate has exact zeros.
    coefficients.col(axis) = problem.basis().analysis() * (samples.col(axis).array() - samples(0, axis)).matrix();
    coefficients(0, axis) += samples(0, axis);
  }
  return coefficients;
}

double pathLength(const math::HarmonicBasis& basis, const Matrix& coefficients, Matrix* gradient) {
  if (basis.hasTwoFrequencies()) return meanPathLength(basis, coefficients, gradient);
  const NodePath path(basis, coefficients);
  double length = 0;
  Matrix byVelocity = Matrix::Zero(coefficients.rows(), coefficients.cols());
  integrateOverPeriod(path, [&](double tau, double weight) {
    const Vector velocity = path.velocity(tau);
    const double speed = velocity.norm();
    length += weight * speed;
    if (gradient && speed > 0) byVelocity += (weight / speed) * path.values(tau) * velocity.transpose();
  });
  // The derivative operator is antisymmetric (sine and cosine of an order are orthogonal with equal norm).
  if (gradient) *gradient = -basis.derivative(byVelocity);
  return length;
}

double maximumDisplacement(const math::HarmonicBasis& basis, const Matrix& coefficients) {
  if (basis.hasTwoFrequencies()) return largestDisplacement(basis, coefficients);
  const NodePath path(basis, coefficients);
  double largest = 0;
  for (const double tau : localMinima(
           path.harmonics(), [&](double at) { return -path.squaredDistance(at); },
           [&](double at) { return -path.distanceRate(at); }))
    largest = std::max(largest, std::sqrt(path.squaredDistance(tau)));
  // A circle about the mean has no farthest point.
  return std::max(largest, std::sqrt(path.squaredDistance(0)));
}

}  // namespace pliant::harmonic
