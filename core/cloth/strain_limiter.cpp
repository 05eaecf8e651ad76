#include "core/cloth/strain_limiter.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/cloth/direction_search.hpp"
#include "core/cloth/gauss_seidel.hpp"
#include "core/cloth/nonlinear_program.hpp"

namespace pliant::cloth {

namespace {

constexpr int ratioSamples = 360;  ///< directions at which a curve is compared with what is reached
/// How far below its maximum a squared ratio may be at the nearest of them.
constexpr double largestRatioDip = 0.01;

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

/// The largest dᵀCd / b² over all directions for an isotropic or orthotropic limit: the larger eigenvalue of C in
/// coordinates in which the limit is a unit circle. (As a root of det(C - λS) it would lose half its digits where both
/// are nearly the same.)
double largestRatio(const Eigen::Matrix2d& metric, const StretchLimit& limit) {
  Eigen::Matrix2d scaled = metric;
  if (const auto* isotropic = std::get_if<IsotropicLimit>(&limit)) {
    scaled /= isotropic->stretch * isotropic->stretch;
  } else {
    const auto& [first, second, angle] = std::get<OrthotropicLimit>(limit);
    const Eigen::Matrix2d axes{
        {std::cos(angle) / first, -std::sin(angle) / second}, {std::sin(angle) / first, std::cos(angle) / second}};
    scaled = axes.transpose() * metric * axes;
  }
  return (scaled(0, 0) + scaled(1, 1)) / 2 + std::hypot((scaled(0, 0) - scaled(1, 1)) / 2, scaled(0, 1));
}

/// The same for a curve, at directions chosen once and then between those that come out highest.
class CurveRatio {
 public:
  explicit CurveRatio(const LimitCurve& curve) : curve_(curve), angles_(samplingAngles(curve, ratioSamples)) {
    for (const double angle : angles_) {
      const double inverse = 1 / curve(angle);
      samples_.emplace_back(std::cos(angle) * inverse, std::sin(angle) * inverse);
    }
    values_.resize(angles_.size());
  }

  double operator()(const Eigen::Matrix2d& metric) {
    for (std::size_t i = 0; i < samples_.size(); ++i) values_[i] = samples_[i].dot(metric * samples_[i]);
    return largestOverDirections(angles_, values_, largestRatioDip, [&](double angle) {
      const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
      const double stretch = curve_(angle);
      return d.dot(metric * d) / (stretch * stretch);
    });
  }

 private:
  const LimitCurve& curve_;
  std::vector<double> angles_;
  std::vector<Eigen::Vector2d> samples_;  ///< d / b
  std::vector<double> values_;
};

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
  std::map<int, CurveRatio> curves;
  for (std::size_t l = 0; l < sheet.limits.size(); ++l)
    if (const auto* curve = std::get_if<LimitCurve>(&sheet.limits[l]))
      curves.emplace(static_cast<int>(l), CurveRatio(*curve));
  Eigen::VectorXd ratios = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sheet.triangles.size()));
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const SheetTriangle& triangle = sheet.triangles[t];
    if (triangle.limit < 0) continue;
    const Eigen::Matrix<double, 3, 2> f = deformationGradient(triangle, positions);
    const Eigen::Matrix2d metric = f.transpose() * f;
    const auto curve = curves.find(triangle.limit);
    const double squared =
        curve != curves.end() ? curve->second(metric) : largestRatio(metric, sheet.limits[triangle.limit]);
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
