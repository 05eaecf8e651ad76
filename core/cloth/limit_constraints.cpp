#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/cloth/stretch_limit.hpp"

namespace pliant::cloth {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int fineSamples = 1440;  ///< directions at which curves are compared

/// dᵀSd = mean + cosine cos 2α + sine sin 2α.
struct Sinusoid {
  double mean = 0, cosine = 0, sine = 0;
  double at(double doubled) const { return mean + cosine * std::cos(doubled) + sine * std::sin(doubled); }
  Eigen::Matrix2d matrix() const { return Eigen::Matrix2d{{mean + cosine, sine}, {sine, mean - cosine}}; }
};

void requireCount(int count, int least) {
  if (count < least || count > 90)
    throw base::InputError("", "The number of constraints must be from " + std::to_string(least) + " to 90, not " +
                                   std::to_string(count) + ".");
}

/// The largest stretch / limit - 1 over all directions for a C given as a sinusoid.
double largestExcess(const Sinusoid& metric, const std::vector<double>& squaredLimits) {
  double largest = 0;
  for (int i = 0; i < fineSamples; ++i)
    largest = std::max(largest, metric.at(2 * pi * i / fineSamples) / squaredLimits[i]);
  return std::sqrt(largest) - 1;
}

/// The worst C ⪰ 0 with dᵀCd <= b² in the given directions. dᵀCd is linear in C, so it is an extreme point of the
/// convex set of all such C: of rank two with three constraints active, or of rank one (C = vvᵀ) with two, for along a
/// single active one (v·d)² is convex.
double worstOvershoot(const std::vector<DirectionLimit>& directions, const std::vector<double>& squaredLimits) {
  const int count = static_cast<int>(directions.size());
  std::vector<Eigen::Vector3d> rows;
  Eigen::VectorXd bounds(count);
  for (int i = 0; i < count; ++i) {
    const double doubled = 2 * directions[i].angle;
    rows.emplace_back(1, std::cos(doubled), std::sin(doubled));
    bounds[i] = directions[i].stretch * directions[i].stretch;
  }
  double overshoot = 0;
  const auto consider = [&](const Eigen::Vector3d& metric) {
    for (int i = 0; i < count; ++i)
      if (rows[i].dot(metric) > bounds[i] * (1 + 1e-9)) return;
    overshoot = std::max(overshoot, largestExcess({metric[0], metric[1], metric[2]}, squaredLimits));
  };
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      Eigen::Matrix2d pair;
      pair << std::cos(directions[i].angle), std::sin(directions[i].angle), std::cos(directions[j].angle),
          std::sin(directions[j].angle);
      for (const double sign : {1.0, -1.0}) {
        const Eigen::Vector2d v = pair.inverse() * Eigen::Vector2d(directions[i].stretch, sign * directions[j].stretch);
        consider({v.squaredNorm() / 2, (v[0] * v[0] - v[1] * v[1]) / 2, v[0] * v[1]});
      }
      for (int k = j + 1; k < count; ++k) {
        Eigen::Matrix3d system;
        system << rows[i].transpose(), rows[j].transpose(), rows[k].transpose();
        const Eigen::Vector3d metric = system.inverse() * Eigen::Vector3d(bounds[i], bounds[j], bounds[k]);
        if (metric.allFinite() && metric[0] >= std::hypot(metric[1], metric[2])) consider(metric);
      }
    }
  return overshoot;
}

std::vector<double> squaredLimitsOf(const StretchLimit& limit) {
  std::vector<double> squared;
  for (int i = 0; i < fineSamples; ++i) {
    const double stretch = stretchAt(limit, pi * i / fineSamples);
    squared.push_back(stretch * stretch);
  }
  return squared;
}

}  // namespace

LimitConstraints exactConstraints(const StretchLimit& limit) {
  if (const auto* isotropic = std::get_if<IsotropicLimit>(&limit))
    return {{isotropic->stretch * isotropic->stretch * Eigen::Matrix2d::Identity()}, {}, 0};
  const auto& [first, second, angle] = std::get<OrthotropicLimit>(limit);
  const double mean = (first * first + second * second) / 2, half = (first * first - second * second) / 2;
  return {{Sinusoid{mean, half * std::cos(2 * angle), half * std::sin(2 * angle)}.matrix()}, {}, 0};
}

LimitConstraints directionConstraints(const StretchLimit& limit, int count) {
  requireCount(count, 2);
  LimitConstraints constraints;
  for (int i = 0; i < count; ++i) {
    const double angle = pi * i / count;
    constraints.directions.push_back({angle, stretchAt(limit, angle)});
  }
  constraints.overshoot = worstOvershoot(constraints.directions, squaredLimitsOf(limit));
  return constraints;
}

LimitConstraints ellipseConstraints(const StretchLimit& limit, int count) {
  requireCount(count, 1);
  const std::vector<double> squaredLimits = squaredLimitsOf(limit);
  std::vector<Sinusoid> envelope;
  LimitConstraints constraints;
  for (int k = 0; k < count; ++k) {
    // s(θ) = b²(θ₀) + slope sin(θ - θ₀) + height (1 - cos(θ - θ₀)), with the least height that keeps it above b².
    const double centre = 2 * pi * k / count;
    const auto squaredLimit = [&](double doubled) {
      const double stretch = stretchAt(limit, doubled / 2);
      return stretch * stretch;
    };
    constexpr double h = 1e-4;
    const double value = squaredLimit(centre);
    const double slope = (squaredLimit(centre + h) - squaredLimit(centre - h)) / (2 * h);
    double height = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < fineSamples; ++i) {
      const double offset = 2 * pi * i / fineSamples - centre;
      const double rise = 1 - std::cos(offset);
      if (rise < 1e-5) continue;  // at the centre itself both sides touch
      height = std::max(height, (squaredLimits[i] - value - slope * std::sin(offset)) / rise);
    }
    const Sinusoid sinusoid{value + height, -height * std::cos(centre) - slope * std::sin(centre),
                            -height * std::sin(centre) + slope * std::cos(centre)};
    envelope.push_back(sinusoid);
    constraints.ellipses.push_back(sinusoid.matrix());
  }
  for (int i = 0; i < fineSamples; ++i) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Sinusoid& sinusoid : envelope) lowest = std::min(lowest, sinusoid.at(2 * pi * i / fineSamples));
    constraints.overshoot = std::max(constraints.overshoot, std::sqrt(lowest / squaredLimits[i]) - 1);
  }
  return constraints;
}

LimitConstraints limitConstraints(const StretchLimit& limit, int count) {
  if (!std::holds_alternative<LimitCurve>(limit)) return exactConstraints(limit);
  const LimitConstraints ellipses = ellipseConstraints(limit, count);
  if (count < 2) return ellipses;
  const LimitConstraints directions = directionConstraints(limit, count);
  return directions.overshoot < ellipses.overshoot ? directions : ellipses;
}

}  // namespace pliant::cloth
