#include "core/cloth/strain_limiter.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/cloth/gauss_seidel.hpp"
#include "core/cloth/nonlinear_program.hpp"

namespace pliant::cloth {

namespace {

constexpr int ratioSamples = 360;  ///< directions at which a curve is compared with what is reached

class ConeLimiter final : public StrainLimiter {
 public:
  ConeLimiter(const solvers::ConeConstraints& constraints, const ProjectionOptions& options)
      : program_(constraints), options_(options.cone) {}

  std::string_view name() const override { return "cone"; }
  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                base::ExecutionContext& context) override {
    return program_.solve(candidate, start, options_, context);
  }

 private:
  solvers::ConeProgram program_;
  solvers::ConeProgramOptions options_;
};

/// Largest λ with det(C - λ S) = 0, S positive definite: the largest dᵀCd / dᵀSd.
double largestRatio(const Eigen::Matrix2d& metric, const Eigen::Matrix2d& bound) {
  const double a = bound.determinant();
  const double half =
      0.5 * (metric(0, 0) * bound(1, 1) + metric(1, 1) * bound(0, 0) - 2 * metric(0, 1) * bound(0, 1)) / a;
  return half + std::sqrt(std::max(0.0, half * half - metric.determinant() / a));
}

}  // namespace

std::array<Eigen::Vector2d, 3> shapeGradients(const Eigen::Matrix3d& corners, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d first = corners.col(1) - corners.col(0), second = corners.col(2) - corners.col(0);
  const Eigen::Vector3d normal = first.cross(second);
  const double longest = std::max({first.squaredNorm(), second.squaredNorm(), (second - first).squaredNorm()});
  if (!(normal.norm() > 1e-10 * longest)) throw base::InputError("", "A limited triangle has no area.");
  const Eigen::Vector3d unit = normal.normalized();
  const Eigen::Vector3d inPlane = direction - direction.dot(unit) * unit;
  if (!(inPlane.norm() > 1e-6 * direction.norm()))
    throw base::InputError("", "The material's direction is normal to a limited triangle; it must lie in the sheet.");
  const Eigen::Vector3d x = inPlane.normalized(), y = unit.cross(x);
  const Eigen::Matrix2d edges{{first.dot(x), second.dot(x)}, {first.dot(y), second.dot(y)}};
  const Eigen::Matrix2d inverse = edges.inverse();
  const Eigen::Vector2d one = inverse.row(0).transpose(), two = inverse.row(1).transpose();
  return {Eigen::Vector2d(-one - two), one, two};
}

Eigen::Matrix<double, 3, 2> deformationGradient(const SheetTriangle& triangle, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix<double, 3, 2> f = Eigen::Matrix<double, 3, 2>::Zero();
  for (int k = 0; k < 3; ++k) f += positions.col(triangle.nodes[k]) * triangle.gradients[k].transpose();
  return f;
}

Eigen::VectorXd stretchRatios(const LimitedSheet& sheet, const Eigen::Matrix3Xd& positions) {
  struct Sample {
    double mean, cosine, sine;  // of dᵀCd / b²
  };
  std::vector<std::vector<Sample>> samples(sheet.limits.size());
  for (std::size_t l = 0; l < sheet.limits.size(); ++l) {
    if (!std::holds_alternative<LimitCurve>(sheet.limits[l])) continue;
    for (int i = 0; i < ratioSamples; ++i) {
      const double angle = std::numbers::pi * i / ratioSamples;
      const double stretch = stretchAt(sheet.limits[l], angle), inverse = 1 / (stretch * stretch);
      samples[l].push_back({inverse, std::cos(2 * angle) * inverse, std::sin(2 * angle) * inverse});
    }
  }
  Eigen::VectorXd ratios = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sheet.triangles.size()));
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const SheetTriangle& triangle = sheet.triangles[t];
    if (triangle.limit < 0) continue;
    const Eigen::Matrix<double, 3, 2> f = deformationGradient(triangle, positions);
    const Eigen::Matrix2d metric = f.transpose() * f;
    double squared = 0;
    if (samples[triangle.limit].empty()) {
      squared = largestRatio(metric, exactConstraints(sheet.limits[triangle.limit]).ellipses.front());
    } else {
      const double mean = (metric(0, 0) + metric(1, 1)) / 2, half = (metric(0, 0) - metric(1, 1)) / 2;
      for (const Sample& sample : samples[triangle.limit])
        squared = std::max(squared, mean * sample.mean + half * sample.cosine + metric(0, 1) * sample.sine);
    }
    ratios[static_cast<Eigen::Index>(t)] = std::sqrt(squared);
  }
  return ratios;
}

Eigen::VectorXd reachedStretch(const LimitedSheet& sheet, const Eigen::Matrix3Xd& positions, int count,
                               const std::vector<int>& triangles) {
  Eigen::VectorXd squared = Eigen::VectorXd::Zero(count);
  const auto add = [&](const SheetTriangle& triangle) {
    const Eigen::Matrix<double, 3, 2> f = deformationGradient(triangle, positions);
    const Eigen::Matrix2d metric = f.transpose() * f;
    for (int i = 0; i < count; ++i) {
      const double doubled = 2 * std::numbers::pi * i / count;
      squared[i] = std::max(squared[i], (metric(0, 0) + metric(1, 1)) / 2 +
                                            (metric(0, 0) - metric(1, 1)) / 2 * std::cos(doubled) +
                                            metric(0, 1) * std::sin(doubled));
    }
  };
  if (triangles.empty())
    for (const SheetTriangle& triangle : sheet.triangles) add(triangle);
  else
    for (const int t : triangles) add(sheet.triangles.at(t));
  return squared.cwiseMax(0).cwiseSqrt();
}

SheetCones sheetCones(const LimitedSheet& sheet, ProjectionNorm norm) {
  SheetCones cones;
  cones.constraints.nodeCount = sheet.nodeCount;
  cones.constraints.fixed = sheet.fixed;
  cones.constraints.masses =
      norm == ProjectionNorm::mass ? sheet.masses : Eigen::VectorXd(Eigen::VectorXd::Ones(sheet.nodeCount));
  for (const LimitConstraints& limit : sheet.constraints) {
    solvers::MetricBounds& bounds = cones.constraints.bounds.emplace_back();
    bounds.ellipses = limit.ellipses;
    for (const DirectionLimit& direction : limit.directions)
      bounds.directions.emplace_back(
          std::cos(direction.angle) / direction.stretch, std::sin(direction.angle) / direction.stretch);
  }
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const SheetTriangle& triangle = sheet.triangles[t];
    if (triangle.limit < 0) continue;
    cones.constraints.elements.push_back({triangle.nodes, triangle.gradients, triangle.limit});
    cones.triangles.push_back(static_cast<int>(t));
  }
  return cones;
}

std::unique_ptr<StrainLimiter> makeStrainLimiter(std::string_view method, const solvers::ConeConstraints& constraints,
                                                 const ProjectionOptions& options) {
  if (method == "cone") return std::make_unique<ConeLimiter>(constraints, options);
  if (method == "gauss_seidel") return makeGaussSeidelLimiter(constraints, options);
  if (method == "nonlinear_program") return makeNonlinearProgramLimiter(constraints, options);
  throw base::InputError("", "There is no projection method \"" + std::string(method) +
                                 "\"; there are cone, gauss_seidel and nonlinear_program.");
}

}  // namespace pliant::cloth
