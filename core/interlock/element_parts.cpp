#include "core/interlock/element_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace pliant::interlock {

using Eigen::Vector3d;

ElementParts::ElementParts(const ElementShape& shape, double arcTurn) : corners_(3, 0) {
  for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
    const auto& [core, radius] = shape.pieces[i];
    if (const auto* curve = std::get_if<ClosedCurve>(&core))
      addCurve(*curve, static_cast<int>(i), radius, arcTurn);
    else
      addSimplices(std::get<SimplexSet>(core), static_cast<int>(i), radius);
  }
  std::vector<Ball> balls;
  for (const Part& part : parts_) balls.push_back(ballOf(part));
  for (const Ball& ball : balls) reach_ = std::max(reach_, ball.centre.norm() + ball.radius);
  std::vector<int> order(parts_.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * parts_.size());
  build(order, balls);
  centres_.resize(3, static_cast<Eigen::Index>(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) centres_.col(static_cast<Eigen::Index>(i)) = nodes_[i].ball.centre;
}

void ElementParts::addCurve(const ClosedCurve& curve, int piece, double radius, double arcTurn) {
  const std::vector<double> points = curve.breakpoints(arcTurn);
  const int first = static_cast<int>(corners_.cols()), count = static_cast<int>(points.size()) - 1;
  corners_.conservativeResize(3, first + count);
  for (int i = 0; i < count; ++i) corners_.col(first + i) = curve.placeAt(points[i]);
  const double bound = curve.secondDerivativeBound();
  for (int i = 0; i < count; ++i) {
    Part part{PartKind::arc, piece, radius, static_cast<int>(curves_.size()), points[i], points[i + 1]};
    part.corners = {first + i, first + (i + 1) % count, 0};
    part.secondBound = bound;
    part.chord = (corners_.col(part.corners[1]) - corners_.col(part.corners[0])).norm();
    // Between samples the curve strays from their chord by at most h²/8 |c''|.
    constexpr int samples = 16;
    const double step = (part.end - part.begin) / samples;
    const Vector3d from = corners_.col(part.corners[0]), chord = corners_.col(part.corners[1]) - from;
    for (int k = 1; k < samples; ++k) {
      const Vector3d toSample = curve.placeAt(part.begin + k * step) - from;
      const double along = std::clamp(toSample.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
      part.sagitta = std::max(part.sagitta, (toSample - along * chord).norm());
    }
    part.sagitta += step * step / 8 * bound;
    parts_.push_back(part);
  }
  curves_.push_back(curve);
}

void ElementParts::addSimplices(const SimplexSet& set, int piece, double radius) {
  const int first = static_cast<int>(corners_.cols());
  corners_.conservativeResize(3, first + set.corners.cols());
  corners_.rightCols(set.corners.cols()) = set.corners;
  std::set<std::array<int, 2>> sides, lone;
  std::set<int> ends, points(set.points.begin(), set.points.end());
  for (const auto& [a, b, c] : set.triangles)
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      sides.insert({std::min(from, to), std::max(from, to)});
  for (const auto& [from, to] : set.segments) lone.insert({std::min(from, to), std::max(from, to)});
  const auto add = [&](PartKind kind, std::array<int, 3> corners, bool bounds) {
    Part part{kind, piece, radius};
    for (int i = 0; i < 3; ++i) part.corners[i] = first + corners[i];
    part.bounds = bounds;
    parts_.push_back(part);
  };
  for (const auto& triangle : set.triangles) add(PartKind::triangle, triangle, false);
  for (const auto* edges : {&sides, &lone})
    for (const auto& [from, to] : *edges) {
      ends.insert({from, to});
      if (edges == &sides || !sides.count({from, to})) add(PartKind::segment, {from, to, to}, edges == &sides);
    }
  points.insert(ends.begin(), ends.end());
  for (const int point : points) add(PartKind::point, {point, point, point}, ends.count(point) > 0);
}

Ball ElementParts::ballOf(const Part& part) const {
  const Vector3d a = corners_.col(part.corners[0]), b = corners_.col(part.corners[1]);
  switch (part.kind) {
    case PartKind::point: return {a, part.radius};
    case PartKind::arc: return {0.5 * (a + b), 0.5 * (b - a).norm() + part.sagitta + part.radius};
    case PartKind::segment: return {0.5 * (a + b), 0.5 * (b - a).norm() + part.radius};
    case PartKind::triangle: break;
  }
  const Vector3d c = corners_.col(part.corners[2]), centre = (a + b + c) / 3;
  return {centre, std::max({(a - centre).norm(), (b - centre).norm(), (c - centre).norm()}) + part.radius};
}

int ElementParts::build(std::span<int> order, const std::vector<Ball>& balls) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({balls[order[0]], order[0], {-1, -1}});
  if (order.size() == 1) return node;
  Eigen::AlignedBox3d box, centres;
  for (const int i : order) {
    const Vector3d extent = Vector3d::Constant(balls[i].radius);
    box.extend(balls[i].centre - extent).extend(balls[i].centre + extent);
    centres.extend(balls[i].centre);
  }
  Ball ball{box.center(), 0};
  for (const int i : order)
    ball.radius = std::max(ball.radius, (balls[i].centre - ball.centre).norm() + balls[i].radius);
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  std::nth_element(order.begin(), middle, order.end(), [&](int i, int j) {
    const double x = balls[i].centre[axis], y = balls[j].centre[axis];
    return x != y ? x < y : i < j;
  });
  const int first = build(order.first(order.size() / 2), balls);
  const int second = build(order.subspan(order.size() / 2), balls);
  nodes_[node] = {ball, -1, {first, second}};
  return node;
}

bool countsAsContact(const Part& a, const Part& b) {
  if (a.kind > b.kind) return countsAsContact(b, a);
  switch (a.kind) {
    case PartKind::arc: return b.kind == PartKind::arc || b.kind == PartKind::triangle || !b.bounds;
    case PartKind::point:
      return b.kind == PartKind::triangle || (!b.bounds && (b.kind == PartKind::segment || !a.bounds));
    case PartKind::segment: return b.kind == PartKind::segment;
    case PartKind::triangle: break;
  }
  return false;
}

}  // namespace pliant::interlock
