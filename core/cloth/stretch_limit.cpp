#include "core/cloth/stretch_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"

namespace pliant::cloth {

namespace {

using std::numbers::pi;

/// Into [0, π).
double halfTurn(double angle) {
  const double turned = angle - pi * std::floor(angle / pi);  // rounding may put it on either side of a boundary
  return turned >= 0 && turned < pi ? turned : 0;
}

}  // namespace

LimitCurve::LimitCurve(std::vector<DirectionLimit> points) : points_(std::move(points)) {
  if (points_.empty()) throw base::InputError("", "A limit curve needs at least one point.");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    DirectionLimit& point = points_[i];
    if (!std::isfinite(point.angle) || !std::isfinite(point.stretch))
      throw base::InputError("", "Point " + std::to_string(i) + " of the limit curve is not a finite number.");
    if (point.stretch <= 0)
      throw base::InputError("", "The stretch of point " + std::to_string(i) + " of the limit curve must be above 0.");
    point.angle = halfTurn(point.angle);
  }
  std::sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
  const std::size_t count = points_.size();
  const auto width = [&](std::size_t i) {
    return i + 1 < count ? points_[i + 1].angle - points_[i].angle : points_[0].angle + pi - points_[i].angle;
  };
  for (std::size_t i = 0; i < count; ++i)  // the last and the first are neighbours as well
    if (width(i) < 1e-9)
      throw base::InputError("", "Two points of the limit curve have the same direction, " +
                                     std::to_string(points_[i].angle * 180 / pi) + " degrees.");
  const auto secant = [&](std::size_t i) { return (points_[(i + 1) % count].stretch - points_[i].stretch) / width(i); };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    const double left = secant(before), right = secant(i);
    if (left * right <= 0) {
      slopes_.push_back(0);
      continue;
    }
    const double wLeft = width(before) + 2 * width(i), wRight = 2 * width(before) + width(i);
    slopes_.push_back((wLeft + wRight) / (wLeft / left + wRight / right));
  }
}

LimitCurve::Piece LimitCurve::pieceAt(double angle) const {
  const double at = halfTurn(angle);
  const auto above = std::upper_bound(points_.begin(), points_.end(), at,
                                      [](double value, const DirectionLimit& point) { return value < point.angle; });
  const std::size_t count = points_.size();
  const auto index = static_cast<std::size_t>(above - points_.begin());
  const std::size_t first = (index + count - 1) % count, second = index % count;
  const double begin = index == 0 ? points_[first].angle - pi : points_[first].angle;
  const double end = index == count ? points_[second].angle + pi : points_[second].angle;
  const double width = end - begin;
  return {
      points_[first].stretch, points_[second].stretch, slopes_[first], slopes_[second], width, (at - begin) / width};
}

double LimitCurve::operator()(double angle) const {
  const auto [begin, end, slopeBegin, slopeEnd, width, t] = pieceAt(angle);
  return begin + (end - begin) * t * t * (3 - 2 * t) + width * t * (1 - t) * (slopeBegin * (1 - t) - slopeEnd * t);
}

double LimitCurve::slope(double angle) const {
  const auto [begin, end, slopeBegin, slopeEnd, width, t] = pieceAt(angle);
  return 6 * (end - begin) / width * t * (1 - t) + slopeBegin * (1 - t) * (1 - 3 * t) + slopeEnd * t * (3 * t - 2);
}

double LimitCurve::curvature(double angle) const {
  const auto [begin, end, slopeBegin, slopeEnd, width, t] = pieceAt(angle);
  return 6 * (end - begin) / (width * width) * (1 - 2 * t) +
         (slopeBegin * (6 * t - 4) + slopeEnd * (6 * t - 2)) / width;
}

double stretchAt(const StretchLimit& limit, double angle) {
  if (const auto* isotropic = std::get_if<IsotropicLimit>(&limit)) return isotropic->stretch;
  if (const auto* curve = std::get_if<LimitCurve>(&limit)) return (*curve)(angle);
  const auto& orthotropic = std::get<OrthotropicLimit>(limit);
  const double relative = angle - orthotropic.angle;
  return std::hypot(orthotropic.first * std::cos(relative), orthotropic.second * std::sin(relative));
}

double smallestStretch(const StretchLimit& limit) {
  if (const auto* isotropic = std::get_if<IsotropicLimit>(&limit)) return isotropic->stretch;
  if (const auto* orthotropic = std::get_if<OrthotropicLimit>(&limit))
    return std::min(orthotropic->first, orthotropic->second);
  double smallest = std::numeric_limits<double>::infinity();  // the cubics have no extrema between the points
  for (const DirectionLimit& point : std::get<LimitCurve>(limit).points()) smallest = std::min(smallest, point.stretch);
  return smallest;
}

}  // namespace pliant::cloth
