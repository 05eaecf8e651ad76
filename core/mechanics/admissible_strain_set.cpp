#include "core/mechanics/admissible_strain_set.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace pliant::mechanics {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// How far each function reaches, as a chord of the unit sphere, among 258 points. It shrinks with the fourth root of
/// their number, half as fast as their spacing, or the interpolant would not converge.
constexpr double supportOf258 = 0.8;
/// Of the cube's faces along each axis.
constexpr int cellsPerSide = 12;
/// Strains nearer to the middle than this fraction of the set's size have the gauge's derivatives of that distance.
constexpr double smallestRadius = 1e-9;

/// φ(r) = (1 - r)⁶ (35 r² + 18 r + 3) / 3, φ'/r and (φ'/r)'/r, for 0 <= r <= 1.
struct Wendland {
  double value, first, second;

  explicit Wendland(double r) {
    const double rest = 1 - r, square = rest * rest, fourth = square * square;
    value = fourth * square * ((35 * r + 18) * r + 3) / 3;
    first = -56.0 / 3 * (5 * r + 1) * fourth * rest;
    second = 560 * fourth;
  }
};

}  // namespace

AdmissibleStrainSet::AdmissibleStrainSet(geometry::SurfaceMesh boundary, const Vector3d& middle)
    : distance_(std::move(boundary)), middle_(middle) {
  const geometry::SurfaceMesh& mesh = distance_.mesh();
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto seen = [&](int corner) -> Vector3d { return mesh.points.col(corner) - middle; };
    if (!(seen(a).dot(seen(b).cross(seen(c))) > 0))
      throw base::InputError("", "The boundary of admissible strains is not seen whole from its middle: triangle " +
                                     std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c) +
                                     " turns away from it.");
  }
  const Eigen::Index count = mesh.points.cols();
  directions_ = (mesh.points.colwise() - middle).colwise().normalized();
  Eigen::VectorXd logarithms = (mesh.points.colwise() - middle).colwise().norm().array().log();
  meanLogarithm_ = logarithms.mean();
  support_ = std::min(2.0, supportOf258 * std::pow(258.0 / static_cast<double>(count), 0.25));
  collectCells();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < count; ++i)
    for (const int j : cells_[cellOf(directions_.col(i))]) {
      const double r = (directions_.col(i) - directions_.col(j)).norm() / support_;
      if (r < 1) entries.emplace_back(static_cast<int>(i), j, Wendland(r).value);
    }
  Eigen::SparseMatrix<double> kernel(count, count);
  kernel.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors(kernel);
  if (factors.info() != Eigen::Success)
    throw base::InputError("", "The boundary of admissible strains has two points in the same direction.");
  const Eigen::VectorXd values = logarithms.array() - meanLogarithm_;
  weights_ = factors.solve(values);

  double squares = 0;
  int samples = 0;
  const auto check = [&](const Vector3d& strain) {
    const double error = gauge(strain).value - 1;
    gaugeError_.largest = std::max(gaugeError_.largest, std::abs(error));
    squares += error * error;
    ++samples;
  };
  for (const auto& corners : mesh.triangles) {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      sum += mesh.points.col(corners[i]);
      check(0.5 * (mesh.points.col(corners[i]) + mesh.points.col(corners[(i + 1) % 3])));
    }
    check(sum / 3);
  }
  gaugeError_.rootMeanSquare = std::sqrt(squares / samples);
}

int AdmissibleStrainSet::cellOf(const Vector3d& direction) const {
  Eigen::Index axis = 0;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  const auto place = [&](Eigen::Index other) {
    const double along = 0.5 * (direction[other] / largest + 1);
    return std::clamp(static_cast<int>(along * cellsPerSide), 0, cellsPerSide - 1);
  };
  const int face = 2 * static_cast<int>(axis) + (direction[axis] > 0 ? 1 : 0);
  return (face * cellsPerSide + place((axis + 1) % 3)) * cellsPerSide + place((axis + 2) % 3);
}

void AdmissibleStrainSet::collectCells() {
  cells_.resize(6 * cellsPerSide * cellsPerSide);
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < cellsPerSide; ++i)
      for (int j = 0; j < cellsPerSide; ++j) {
        const int axis = face / 2;
        const auto at = [&](double u, double v) {
          Vector3d direction;
          direction[axis] = face % 2 ? 1 : -1;
          direction[(axis + 1) % 3] = 2 * u / cellsPerSide - 1;
          direction[(axis + 2) % 3] = 2 * v / cellsPerSide - 1;
          return Vector3d(direction.normalized());
        };
        const Vector3d centre = at(i + 0.5, j + 0.5);
        double radius = 0;
        for (const int k : {0, 1})
          for (const int l : {0, 1}) radius = std::max(radius, (at(i + k, j + l) - centre).norm());
        std::vector<int>& cell = cells_[(face * cellsPerSide + i) * cellsPerSide + j];
        for (Eigen::Index c = 0; c < directions_.cols(); ++c)
          if ((directions_.col(c) - centre).norm() < support_ + radius) cell.push_back(static_cast<int>(c));
      }
}

StrainFunction AdmissibleStrainSet::logarithm(const Vector3d& direction, bool withDerivatives) const {
  StrainFunction result;
  result.value = meanLogarithm_;
  const double scale = 1 / (support_ * support_);
  for (const int c : cells_[cellOf(direction)]) {
    const Vector3d offset = direction - directions_.col(c);
    const double squared = scale * offset.squaredNorm();
    if (squared >= 1) continue;
    const Wendland kernel(std::sqrt(squared));
    result.value += weights_[c] * kernel.value;
    if (!withDerivatives) continue;
    const double first = weights_[c] * scale * kernel.first, second = weights_[c] * scale * scale * kernel.second;
    result.gradient += first * offset;
    result.hessian += second * offset * offset.transpose();
    result.hessian.diagonal().array() += first;
  }
  return result;
}

StrainFunction AdmissibleStrainSet::gauge(const Vector3d& strain, bool withDerivatives) const {
  const Vector3d offset = strain - middle_;
  const double length = offset.norm(), radius = std::max(length, smallestRadius * size());
  const Vector3d u = length > 0 ? Vector3d(offset / length) : Vector3d::UnitX();
  // h(u) = exp(-log ρ(u)), and r h(v/|v|) with its derivatives along the sphere alone.
  const StrainFunction log = logarithm(u, withDerivatives);
  const double h = std::exp(-log.value);
  if (!withDerivatives) return {length * h};
  const Vector3d slope = -h * log.gradient;
  const Matrix3d second = h * (log.gradient * log.gradient.transpose() - log.hessian);
  const Matrix3d onSphere = Matrix3d::Identity() - u * u.transpose();
  StrainFunction result;
  result.value = length * h;
  result.gradient = h * u + onSphere * slope;
  result.hessian = (onSphere * second * onSphere + (h - u.dot(slope)) * onSphere) / radius;
  return result;
}

StrainFunction AdmissibleStrainSet::distance(const Vector3d& strain) const {
  const geometry::SurfaceDistance::Closest closest = distance_.closest(strain);
  const double scale = 1 / size();
  return {scale * closest.distance, scale * closest.gradient, scale * closest.hessian};
}

}  // namespace pliant::mechanics
