#include "ui/render/boundary_geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace pliant::render {
namespace {

constexpr double turn = 2 * std::numbers::pi, rounding = 1e-9;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Raises the radii of the rays that the segment from `p` to `q` crosses, all about the origin.
void coverRays(const Eigen::Vector2d& p, const Eigen::Vector2d& q, std::vector<double>& radii) {
  const auto count = static_cast<double>(radii.size());
  const double begin = std::atan2(p.y(), p.x());
  double span = std::atan2(q.y(), q.x()) - begin;
  span -= turn * std::round(span / turn);
  const double low = std::min(begin, begin + span), high = std::max(begin, begin + span);
  for (double ray = std::ceil(low / turn * count - 1e-9); ray <= high / turn * count + 1e-9; ++ray) {
    const double angle = turn * ray / count;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle)), along = q - p;
    const double slant = cross(direction, along);
    // Where a ray runs along the segment, all of it is on the ray.
    const double farthest = std::max(p.norm(), q.norm());
    const double radius = std::abs(slant) > 1e-300 ? std::min(cross(p, along) / slant, farthest) : farthest;
    const auto index = static_cast<std::size_t>(ray + 2 * count) % radii.size();
    radii[index] = std::max(radii[index], radius);
  }
}

/// Segments between the points of `places`, put together to curves: each point is the end of two segments at most.
std::vector<SliceCurve> joined(const std::vector<Eigen::Vector3d>& places,
                               const std::vector<std::array<int, 2>>& segments) {
  std::vector<std::vector<int>> ends(places.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const int point : segments[i]) ends[static_cast<std::size_t>(point)].push_back(static_cast<int>(i));
  std::vector<bool> used(segments.size(), false);
  std::vector<SliceCurve> curves;
  const auto walk = [&](int first) {
    std::vector<int> line{first};
    while (true) {
      const auto& around = ends[static_cast<std::size_t>(line.back())];
      const auto next = std::find_if(
          around.begin(), around.end(), [&](int segment) { return !used[static_cast<std::size_t>(segment)]; });
      if (next == around.end()) break;
      used[static_cast<std::size_t>(*next)] = true;
      const auto& [a, b] = segments[static_cast<std::size_t>(*next)];
      line.push_back(a == line.back() ? b : a);
    }
    if (line.size() < 2) return;
    SliceCurve curve;
    curve.closed = line.size() > 2 && line.front() == line.back();
    if (curve.closed) line.pop_back();
    curve.points.resize(3, static_cast<Eigen::Index>(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i)
      curve.points.col(static_cast<Eigen::Index>(i)) = places[static_cast<std::size_t>(line[i])];
    curves.push_back(std::move(curve));
  };
  for (std::size_t i = 0; i < places.size(); ++i)
    if (ends[i].size() == 1) walk(static_cast<int>(i));  // open ones from an end
  for (std::size_t i = 0; i < places.size(); ++i) walk(static_cast<int>(i));
  return curves;
}

}  // namespace

Eigen::Matrix2Xd shadowOutline(const Points& points, const TriangleList& triangles, int axis, int count) {
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto flat = [&](int point) { return Eigen::Vector2d(points(first, point), points(second, point)); };
  for (const auto& triangle : triangles)
    for (const int corner : triangle) {
      low = low.cwiseMin(flat(corner));
      high = high.cwiseMax(flat(corner));
    }
  if (triangles.empty()) return Eigen::Matrix2Xd(2, 0);
  const Eigen::Vector2d middle = 0.5 * (low + high);
  std::vector<double> radii(static_cast<std::size_t>(count), 0.0);
  for (const auto& [a, b, c] : triangles)
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      coverRays(flat(from) - middle, flat(to) - middle, radii);
  Eigen::Matrix2Xd outline(2, count);
  for (int i = 0; i < count; ++i)
    outline.col(i) = middle + radii[static_cast<std::size_t>(i)] *
                                  Eigen::Vector2d(std::cos(turn * i / count), std::sin(turn * i / count));
  return outline;
}

std::vector<SliceCurve> sliceCurves(const Points& points, const TriangleList& triangles, int axis, double position) {
  std::vector<Eigen::Vector3d> places;
  std::map<std::array<int, 2>, int> crossings;  // of edges
  const auto isAbove = [&](int point) { return points(axis, point) >= position; };
  const auto crossing = [&](int a, int b) {
    const auto [found, isNew] =
        crossings.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(places.size()));
    if (isNew) {
      const double part = (position - points(axis, a)) / (points(axis, b) - points(axis, a));
      places.emplace_back(points.col(a) + part * (points.col(b) - points.col(a)));
    }
    return found->second;
  };
  std::vector<std::array<int, 2>> segments;
  for (const auto& [a, b, c] : triangles) {
    std::vector<int> ends;
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      if (isAbove(from) != isAbove(to)) ends.push_back(crossing(from, to));
    if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
  }
  return joined(places, segments);
}

std::optional<SurfaceHit> firstHit(const Points& points, const TriangleList& triangles, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  std::optional<SurfaceHit> nearest;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const Eigen::Vector3d u = points.col(b) - points.col(a), v = points.col(c) - points.col(a);
    const Eigen::Vector3d normal = u.cross(v);
    const double slant = normal.dot(direction);
    if (slant == 0) continue;
    const Eigen::Vector3d from = origin - points.col(a);
    const double distance = -normal.dot(from) / slant;
    if (distance <= 0 || (nearest && distance >= nearest->distance)) continue;
    const Eigen::Vector3d place = from + distance * direction;
    const double area = normal.squaredNorm();
    const double second = u.cross(place).dot(normal) / area, first = place.cross(v).dot(normal) / area;
    // A ray through a corner or an edge meets one of its triangles, whatever rounding says.
    if (first < -rounding || second < -rounding || first + second > 1 + rounding) continue;
    nearest = SurfaceHit{static_cast<int>(i), distance, {1 - first - second, first, second}};
  }
  return nearest;
}

}  // namespace pliant::render
