#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/cloth/direction_search.hpp"

namespace pliant::cloth {

namespace {

using std::numbers::pi;
constexpr int fineSamples = 1440;  ///< directions at which curves are compared
/// Of a ratio of squared stretches between two neighbouring directions, below its maximum.
constexpr double largestDip = 0.01;

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

/// b² of a limit that is exactly one. Throws std::bad_variant_access for a curve.
Sinusoid sinusoidOf(const StretchLimit& limit) {
  if (const auto* isotropic = std::get_if<IsotropicLimit>(&limit)) return {isotropic->stretch * isotropic->stretch};
  const auto& [first, second, angle] = std::get<OrthotropicLimit>(limit);
  const double mean = (first * first + second * second) / 2, half = (first * first - second * second) / 2;
  return {mean, half * std::cos(2 * angle), half * std::sin(2 * angle)};
}

/// b² and its derivatives by θ = 2α.
struct SquaredLimit {
  double value = 0, slope = 0, curvature = 0;
};

SquaredLimit squaredLimitAt(const StretchLimit& limit, double angle) {
  if (const auto* curve = std::get_if<LimitCurve>(&limit)) {
    const double b = (*curve)(angle), slope = curve->slope(angle);
    return {b * b, b * slope, (slope * slope + b * curve->curvature(angle)) / 2};
  }
  const Sinusoid sinusoid = sinusoidOf(limit);
  const double cosine = std::cos(2 * angle), sine = std::sin(2 * angle);
  return {sinusoid.at(2 * angle), sinusoid.sine * cosine - sinusoid.cosine * sine,
          -sinusoid.cosine * cosine - sinusoid.sine * sine};
}

/// A limit with the directions at which to compare something with it.
struct SampledLimit {
  explicit SampledLimit(const StretchLimit& given) : limit(given), angles(samplingAngles(given, fineSamples)) {
    for (const double angle : angles) squared.push_back(squaredAt(angle));
    for (std::size_t i = 1; i < angles.size(); ++i) spacing = std::min(spacing, angles[i] - angles[i - 1]);
  }
  double squaredAt(double angle) const {
    const double stretch = stretchAt(limit, angle);
    return stretch * stretch;
  }

  const StretchLimit& limit;
  std::vector<double> angles;
  std::vector<double> squared;        ///< b² there
  double spacing = pi / fineSamples;  ///< the least between two of them
};

/// The largest stretch / limit - 1 over all directions for a C given as a sinusoid.
double largestExcess(const Sinusoid& metric, const SampledLimit& limit) {
  std::vector<double> ratios(limit.angles.size());
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] = metric.at(2 * limit.angles[i]) / limit.squared[i];
  const double largest = largestOverDirections(
      limit.angles, ratios, largestDip, [&](double angle) { return metric.at(2 * angle) / limit.squaredAt(angle); });
  return std::sqrt(largest) - 1;
}

/// The worst C ⪰ 0 with dᵀCd <= b² in the given directions. dᵀCd is linear in C, so it is an extreme point of the
/// convex set of all such C: of rank two with three constraints active, or of rank one (C = vvᵀ) with two, for along a
/// single active one (v·d)² is convex.
double worstOvershoot(const std::vector<DirectionLimit>& directions, const SampledLimit& limit) {
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
    overshoot = std::max(overshoot, largestExcess({metric[0], metric[1], metric[2]}, limit));
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

/// The flattest sinusoid that touches b² in the direction `centre` and is above it everywhere else:
/// s(θ) = b²(θ₀) + (b²)'(θ₀) sin(θ - θ₀) + height (1 - cos(θ - θ₀)) with the least height that does it.
Sinusoid touchingSinusoid(const SampledLimit& limit, double centre) {
  const auto here = squaredLimitAt(limit.limit, centre);
  const double value = here.value, slope = here.slope, curvature = here.curvature;
  // So close to the centre [rad] the quotient drowns in rounding; it tends to the curvature, on either side.
  const double touching = 0.05 * limit.spacing;
  const double atCentre = std::max(curvature, squaredLimitAt(limit.limit, centre - 1e-6 * touching).curvature);
  const auto heightFor = [&](double angle) {
    const double offset = angle - centre, half = std::sin(offset);
    if (std::abs(half) < touching) return atCentre;
    return (limit.squaredAt(angle) - value - slope * std::sin(2 * offset)) / (2 * half * half);
  };
  const double height = std::max(atCentre, largestOverDirections(limit.angles, heightFor));
  const double doubled = 2 * centre;
  return {value + height, -height * std::cos(doubled) - slope * std::sin(doubled),
          -height * std::sin(doubled) + slope * std::cos(doubled)};
}

}  // namespace

LimitConstraints exactConstraints(const StretchLimit& limit) { return {{sinusoidOf(limit).matrix()}, {}, 0}; }

LimitConstraints directionConstraints(const StretchLimit& limit, int count) {
  requireCount(count, 2);
  LimitConstraints constraints;
  for (int i = 0; i < count; ++i) {
    const double angle = pi * i / count;
    constraints.directions.push_back({angle, stretchAt(limit, angle)});
  }
  constraints.overshoot = worstOvershoot(constraints.directions, SampledLimit(limit));
  return constraints;
}

LimitConstraints ellipseConstraints(const StretchLimit& limit, int count) {
  requireCount(count, 1);
  const SampledLimit sampled(limit);
  std::vector<Sinusoid> sinusoids;
  LimitConstraints constraints;
  for (int k = 0; k < count; ++k) {
    sinusoids.push_back(touchingSinusoid(sampled, pi * k / count));
    constraints.ellipses.push_back(sinusoids.back().matrix());
  }
  const double largest = largestOverDirections(sampled.angles, [&](double angle) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Sinusoid& sinusoid : sinusoids) lowest = std::min(lowest, sinusoid.at(2 * angle));
    return lowest / sampled.squaredAt(angle);
  });
  constraints.overshoot = std::sqrt(std::max(1.0, largest)) - 1;
  return constraints;
}

LimitConstraints limitConstraints(const StretchLimit& limit, int count) {
  if (!std::holds_alternative<LimitCurve>(limit)) return exactConstraints(limit);
  LimitConstraints ellipses = ellipseConstraints(limit, count);
  if (count < 2) return ellipses;
  LimitConstraints directions = directionConstraints(limit, count);
  if (directions.overshoot < ellipses.overshoot) return directions;
  return ellipses;
}

}  // namespace pliant::cloth
