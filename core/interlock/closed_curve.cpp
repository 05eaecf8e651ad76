#include "core/interlock/closed_curve.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

namespace pliant::interlock {

using Eigen::Vector3d;

ClosedCurve::ClosedCurve(const Vector3d& centre, const std::vector<Harmonic>& harmonics) : centre_(centre) {
  std::map<int, Harmonic> sums;
  for (const auto& [order, cosine, sine] : harmonics) {
    if (order == 0) {
      centre_ += cosine;
      continue;
    }
    Harmonic& sum =
        sums.try_emplace(std::abs(order), Harmonic{std::abs(order), Vector3d::Zero(), Vector3d::Zero()}).first->second;
    sum.cosine += cosine;
    sum.sine += order < 0 ? Vector3d(-sine) : sine;
  }
  for (const auto& [order, harmonic] : sums) harmonics_.push_back(harmonic);
}

ClosedCurve ClosedCurve::circle(const Vector3d& centre, const Vector3d& normal, double radius) {
  const Vector3d first = normal.unitOrthogonal();
  return ellipse(centre, radius * first, radius * normal.normalized().cross(first));
}

ClosedCurve ClosedCurve::ellipse(const Vector3d& centre, const Vector3d& first, const Vector3d& second) {
  return {centre, {{1, first, second}}};
}

ClosedCurve ClosedCurve::torusCurve(int p, int q, double a, double b, double c) {
  // cos qt cos pt and cos qt sin pt as sums over the orders q + p and q - p.
  return {Vector3d::Zero(),
          {{p, {a, 0, 0}, {0, a, 0}},
           {q + p, {0.5 * b, 0, 0}, {0, 0.5 * b, 0}},
           {q - p, {0.5 * b, 0, 0}, {0, -0.5 * b, 0}},
           {q, Vector3d::Zero(), {0, 0, c}}}};
}

ClosedCurve::Point ClosedCurve::at(double t) const {
  Point point{centre_, Vector3d::Zero(), Vector3d::Zero()};
  const double c = std::cos(t), s = std::sin(t);
  double cosine = 1, sine = 0;
  int reached = 0;
  for (const auto& [k, a, b] : harmonics_) {
    for (; reached < k; ++reached) {
      const double next = cosine * c - sine * s;
      sine = sine * c + cosine * s;
      cosine = next;
    }
    const Vector3d term = cosine * a + sine * b;
    point.place += term;
    point.tangent += k * (cosine * b - sine * a);
    point.second -= (k * k) * term;
  }
  return point;
}

Vector3d ClosedCurve::placeAt(double t) const { return at(t).place; }

ClosedCurve ClosedCurve::rotated(const Eigen::Matrix3d& rotation) const {
  ClosedCurve curve = *this;
  curve.centre_ = rotation * centre_;
  for (Harmonic& harmonic : curve.harmonics_) {
    harmonic.cosine = (rotation * harmonic.cosine).eval();
    harmonic.sine = (rotation * harmonic.sine).eval();
  }
  return curve;
}

double ClosedCurve::secondDerivativeBound() const {
  double bound = 0;
  for (const auto& [k, a, b] : harmonics_) bound += k * k * std::sqrt(a.squaredNorm() + b.squaredNorm());
  return bound;
}

std::vector<double> ClosedCurve::breakpoints(double turn) const {
  constexpr double shift = 0.0731;
  const int highest = harmonics_.empty() ? 1 : harmonics_.back().order;
  const int samples = 512 * highest;
  const double step = 2 * std::numbers::pi / samples;
  // How far the tangent has turned up to each sample, by the midpoint rule.
  std::vector<double> turned(samples + 1, 0);
  for (int i = 0; i < samples; ++i) {
    const Point point = at(shift + (i + 0.5) * step);
    const double speed = point.tangent.squaredNorm();
    const double rate = speed > 0 ? point.tangent.cross(point.second).norm() / speed : 0;
    turned[i + 1] = turned[i] + rate * step;
  }
  const int count = std::max(3, static_cast<int>(std::ceil(turned.back() / turn - 1e-9)));
  std::vector<double> points{shift};
  for (int i = 1, sample = 0; i < count; ++i) {
    const double wanted = turned.back() * i / count;
    while (turned[sample + 1] < wanted) ++sample;
    const double share = (wanted - turned[sample]) / (turned[sample + 1] - turned[sample]);
    points.push_back(shift + (sample + share) * step);
  }
  points.push_back(shift + 2 * std::numbers::pi);
  return points;
}

}  // namespace pliant::interlock
