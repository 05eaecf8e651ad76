#include "core/interlock/swept_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant::interlock {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using geometry::SimplexPair;

constexpr double usedShare = 0.8;      // of a pair's gap: where the search ends
constexpr double advanceShare = 0.9;   // of the gap that is left, in one advance
constexpr double shareOfRadii = 0.95;  // of the path that could take thick parts through one another
constexpr int mostAdvances = 1000;     // any fraction reached on the way is safe

/// A place that turns about an axis through the origin: x(t) = middle + first cos(rate t) + second sin(rate t).
struct TurningPoint {
  Vector3d middle, first, second;
  double rate;

  TurningPoint(const Vector3d& place, const Vector3d& turn) : rate(turn.norm()) {
    if (rate == 0) {
      middle = place;
      first = second = Vector3d::Zero();
      return;
    }
    const Vector3d axis = turn / rate;
    middle = axis * axis.dot(place);
    first = place - middle;
    second = axis.cross(place);
  }
  Vector3d at(double t) const { return middle + std::cos(rate * t) * first + std::sin(rate * t) * second; }
  Vector3d velocityAt(double t) const { return rate * (std::cos(rate * t) * second - std::sin(rate * t) * first); }
  double acceleration() const { return rate * rate * first.norm(); }
  double speed() const { return rate * first.norm(); }
};

/// How two elements, or an element and an image, move.
struct PairMotion {
  Vector3d offset, drift;  ///< origin_A - origin_B, and how it changes [m]
  Vector3d turnA, turnB;   ///< rotation vectors [rad]
  double beyond;           ///< [m]
};

/// No pair of places of the balls moves by more than this relative to one another until the time `limit` [m].
double pathOf(const PairMotion& motion, const Vector3d& armA, double radiusA, const Vector3d& armB, double radiusB,
              double limit) {
  const Vector3d speedA = motion.turnA.cross(armA), speedB = motion.turnB.cross(armB);
  const double rateA = motion.turnA.norm(), rateB = motion.turnB.norm();
  const double centres =
      (motion.drift + speedA - speedB).norm() + 0.5 * limit * (rateA * speedA.norm() + rateB * speedB.norm());
  return limit * (std::min(centres, motion.drift.norm() + speedA.norm() + speedB.norm()) + rateA * radiusA +
                  rateB * radiusB + motion.beyond);
}

/// Two parts that are both simplices.
double safeTimeOfSimplices(const PlacedPart& a, const PlacedPart& b, const PairMotion& motion, double limit,
                           double near) {
  const SimplexParts parts = simplexParts(a, b, Vector3d::Zero());
  const int count = geometry::cornerCount(parts.kind), firstCount = geometry::firstCornerCount(parts.kind);
  const double radii = a.part->radius + b.part->radius;
  std::vector<TurningPoint> points;
  std::array<bool, 4> ofA{};
  double curving = 0, curvingOther = 0;  // largest accelerations of the two
  for (int i = 0; i < count; ++i) {
    ofA[i] = (i < firstCount) != parts.swapped;
    points.emplace_back(parts.corners.col(i), ofA[i] ? motion.turnA : motion.turnB);
    double& own = ofA[i] ? curving : curvingOther;
    own = std::max(own, points.back().acceleration());
  }
  curving += curvingOther;
  geometry::Corners now = geometry::Corners::Zero();
  double time = 0, least = 0;
  for (int advance = 0; advance < mostAdvances; ++advance) {
    for (int i = 0; i < count; ++i) {
      now.col(i) = points[i].at(time);
      if (ofA[i]) now.col(i) += motion.offset + time * motion.drift;
    }
    const geometry::ClosestPoints closest = geometry::closestPoints(parts.kind, now);
    const double gap = std::sqrt(closest.squaredDistance) - radii - time * motion.beyond;
    if (advance == 0) {
      if (!(gap > 0)) return 0;
      least = std::min((1 - usedShare) * gap, near);
    } else if (gap <= least) {
      return time;
    }
    const Vector3d n = geometry::directionBetween(now, closest);  // from the second to the first simplex
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, firstSpeed = -lowest,
           secondSpeed = -lowest;
    for (int i = 0; i < count; ++i) {
      const double place = n.dot(now.col(i) - now.col(0));
      const double speed = n.dot(points[i].velocityAt(time) + (ofA[i] ? motion.drift : Vector3d::Zero()));
      if (i < firstCount) {
        lowest = std::min(lowest, place);
        firstSpeed = std::max(firstSpeed, -speed);
      } else {
        highest = std::max(highest, place);
        secondSpeed = std::max(secondSpeed, speed);
      }
    }
    const double separation = lowest - highest - radii - time * motion.beyond;
    if (!(separation > 0)) return time;
    // speed τ + ½ curving τ² = what may be used.
    const double speed = firstSpeed + secondSpeed + motion.beyond, use = advanceShare * separation;
    const double root = std::sqrt(speed * speed + 2 * curving * use);
    const double step = speed > 0     ? 2 * use / (speed + root)
                        : curving > 0 ? (root - speed) / curving
                                      : std::numeric_limits<double>::infinity();
    if (!(time + step < limit)) return limit;
    if (!(step > 0)) return time;
    time += step;
  }
  return time;
}

/// At least one of them an arc, which has a radius.
double safeTimeOfArcs(const PlacedPart& a, const PlacedPart& b, const PairMotion& motion, double path, double limit) {
  const double radii = a.part->radius + b.part->radius;
  const int steps = static_cast<int>(std::ceil(path / (shareOfRadii * 2 * radii)));
  double safe = 0;
  for (int i = 1; i <= steps; ++i) {
    const double time = limit * i / steps;
    const auto turned = [&](const PlacedPart& part, const Vector3d& turn, ClosedCurve& curve) {
      const double angle = turn.norm();
      const Matrix3d rotation =
          angle > 0 ? Eigen::AngleAxisd(time * angle, turn / angle).toRotationMatrix() : Matrix3d::Identity();
      PlacedPart result = part;
      result.corners = rotation * part.corners;
      if (part.curve) {
        curve = part.curve->rotated(rotation);
        result.curve = &curve;
      }
      return result;
    };
    ClosedCurve curveA(Vector3d::Zero(), {}), curveB = curveA;
    const PlacedPart nowA = turned(a, motion.turnA, curveA), nowB = turned(b, motion.turnB, curveB);
    if (!(gapBetween(nowA, nowB, motion.offset + time * motion.drift) > time * motion.beyond)) return safe;
    safe = time;
  }
  return limit;
}

}  // namespace

double safeFraction(const CellContact& contact, const CellState& state, const Eigen::VectorXd& motion,
                    const Eigen::VectorXd& beyond, double reach, double near) {
  const UnitCell& cell = contact.cell();
  const std::size_t count = cell.elements.size();
  const Eigen::Matrix2d rate = stretchOf(motion.tail<3>()) - Eigen::Matrix2d::Identity();
  std::vector<Eigen::Matrix3Xd> centres(count), corners(count);
  std::vector<std::vector<ClosedCurve>> curves(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ElementParts& parts = contact.partsOf(static_cast<int>(i));
    centres[i] = state.rotations[i] * parts.centres();
    corners[i] = state.rotations[i] * parts.corners();
    for (const ClosedCurve& curve : parts.curves()) curves[i].push_back(curve.rotated(state.rotations[i]));
  }
  const auto placed = [&](int element, int part) {
    const Part& own = contact.partsOf(element).parts()[part];
    PlacedPart result{&own, own.kind == PartKind::arc ? &curves[element][own.curve] : nullptr, {}};
    for (int i = 0; i < 3; ++i) result.corners.col(i) = corners[element].col(own.corners[i]);
    return result;
  };

  double limit = 1;
  std::vector<std::array<int, 2>> stack;
  for (const auto& [a, b, shift] : contact.nearElements(state, reach)) {
    const ElementParts &first = contact.partsOf(a), &second = contact.partsOf(b);
    PairMotion pair{contact.offsetOf(state, a, b, shift), motion.segment<3>(6 * a) - motion.segment<3>(6 * b),
                    motion.segment<3>(6 * a + 3), motion.segment<3>(6 * b + 3), beyond[a] + beyond[b]};
    pair.drift.head<2>() -= rate * (cell.lattice * Eigen::Vector2d(shift[0], shift[1]));
    stack.assign(1, {0, 0});
    while (!stack.empty()) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      const ElementParts::Node &nodeA = first.nodes()[i], &nodeB = second.nodes()[j];
      const double path =
          pathOf(pair, centres[a].col(i), nodeA.ball.radius, centres[b].col(j), nodeB.ball.radius, limit);
      const double touching = nodeA.ball.radius + nodeB.ball.radius + path;
      if ((centres[a].col(i) + pair.offset - centres[b].col(j)).squaredNorm() > touching * touching) continue;
      if (nodeA.part < 0 || nodeB.part < 0) {
        if (nodeB.part >= 0 || (nodeA.part < 0 && nodeA.ball.radius > nodeB.ball.radius))
          for (const int child : nodeA.children) stack.push_back({child, j});
        else
          for (const int child : nodeB.children) stack.push_back({i, child});
        continue;
      }
      const Part &partA = first.parts()[nodeA.part], &partB = second.parts()[nodeB.part];
      if (path < shareOfRadii * 2 * (partA.radius + partB.radius) || !countsAsContact(partA, partB)) continue;
      const PlacedPart placedA = placed(a, nodeA.part), placedB = placed(b, nodeB.part);
      const bool arcs = partA.kind == PartKind::arc || partB.kind == PartKind::arc;
      limit = arcs ? safeTimeOfArcs(placedA, placedB, pair, path, limit)
                   : safeTimeOfSimplices(placedA, placedB, pair, limit, near);
      if (!(limit > 0)) return 0;
    }
  }
  return limit;
}

double farthestMove(const CellContact& contact, const CellState& from, const CellState& to) {
  double farthest = 0;
  for (int i = 0; i < static_cast<int>(from.rotations.size()); ++i) {
    const double angle = Eigen::AngleAxisd(to.rotations[i] * from.rotations[i].transpose()).angle();
    farthest =
        std::max(farthest, (to.positions.col(i) - from.positions.col(i)).norm() + angle * contact.partsOf(i).reach());
  }
  return farthest;
}

}  // namespace pliant::interlock
