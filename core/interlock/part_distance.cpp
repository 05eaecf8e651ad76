#include "core/interlock/part_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/interlock/arc_places.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Vector3d;
using geometry::SimplexPair;

/// Slope and curvature of a function of one variable.
struct Derivatives {
  double slope, curvature;
};

/// A minimum of a function on [begin, end] near `start`: Newton's method kept within a bracket.
template <typename Function>
double minimumOnInterval(double begin, double end, double start, Function&& derivativesAt) {
  double low = begin, high = end, at = start;
  bool triedBegin = false, triedEnd = false;
  for (int i = 0; i < 80; ++i) {
    const auto [slope, curvature] = derivativesAt(at);
    if (slope == 0 || (at == begin && slope > 0) || (at == end && slope < 0)) return at;
    triedBegin |= at == begin;
    triedEnd |= at == end;
    (slope > 0 ? high : low) = at;
    double next = curvature > 0 ? at - slope / curvature : (slope > 0 ? low : high);
    if (next <= low) next = low == begin && !triedBegin ? begin : 0.5 * (low + at);
    if (next >= high) next = high == end && !triedEnd ? end : 0.5 * (at + high);
    if (std::abs(next - at) <= 2e-16 * (1 + std::abs(at))) return next;
    at = next;
  }
  return at;
}

/// The parameter of the arc at which it is nearest to the point p.
double closestOnArc(const PlacedPart& arc, const Vector3d& p, double start, ClosedCurve::Point& point) {
  double last = std::numeric_limits<double>::quiet_NaN();
  const double t = minimumOnInterval(arc.part->begin, arc.part->end, start, [&](double at) -> Derivatives {
    point = arc.curve->at(last = at);
    const Vector3d toPoint = point.place - p;
    return {toPoint.dot(point.tangent), point.tangent.squaredNorm() + toPoint.dot(point.second)};
  });
  if (t != last) point = arc.curve->at(t);
  return t;
}

bool isInside(const Part& arc, double t) { return t > arc.begin && t < arc.end; }

SimplexPair pairWithPoint(PartKind kind) {
  return kind == PartKind::triangle  ? SimplexPair::pointTriangle
         : kind == PartKind::segment ? SimplexPair::pointEdge
                                     : SimplexPair::pointPoint;
}

void addFree(ClosestArcs& closest, bool ofA, const Vector3d& tangent, double bend) {
  closest.ofA[closest.freeCount] = ofA;
  closest.tangents.col(closest.freeCount) = tangent;
  closest.bend[closest.freeCount++] = bend;
}

ClosestArcs betweenArcs(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset, ArcPlaces& places) {
  const geometry::Corners chords =
      (geometry::Corners() << a.corners.leftCols<2>().colwise() + offset, b.corners.leftCols<2>()).finished();
  const auto straight = geometry::closestPoints(SimplexPair::edgeEdge, chords);
  const auto from = [](const Part& part, double share) { return part.begin + share * (part.end - part.begin); };
  double t = from(*b.part, -straight.weights[3]);
  ClosedCurve::Point onA, onB;
  double last = std::numeric_limits<double>::quiet_NaN();
  const auto derivativesAt = [&](double s) -> Derivatives {
    onA = a.curve->at(last = s);
    t = closestOnArc(b, onA.place + offset, t, onB);
    const Vector3d between = onA.place + offset - onB.place;
    Derivatives result{between.dot(onA.tangent), onA.tangent.squaredNorm() + between.dot(onA.second)};
    if (isInside(*b.part, t)) {
      const double mixed = onA.tangent.dot(onB.tangent);
      result.curvature -= mixed * mixed / (onB.tangent.squaredNorm() - between.dot(onB.second));
    }
    return result;
  };
  const double firstT = t;
  double s = minimumOnInterval(a.part->begin, a.part->end, from(*a.part, straight.weights[1]), derivativesAt);
  if (derivativesAt(s).curvature < 0.1 * onA.tangent.squaredNorm()) {
    // The distance is flat along the curves, so that it may have two minima: the other is found from the ends.
    double least = (onA.place + offset - onB.place).squaredNorm(), bestT = t;
    for (const double start : {a.part->begin, a.part->end}) {
      t = firstT;
      const double other = minimumOnInterval(a.part->begin, a.part->end, start, derivativesAt);
      derivativesAt(other);
      const double squared = (onA.place + offset - onB.place).squaredNorm();
      if (squared < least) least = squared, s = other, bestT = t;
    }
    t = bestT;
  }
  if (s != last) derivativesAt(s);
  ClosestArcs closest{onA.place + offset - onB.place, onA.place, onB.place};
  places.parameterA = s;
  places.parameterB = t;
  if (isInside(*a.part, s)) addFree(closest, true, onA.tangent, closest.between.dot(onA.second));
  if (isInside(*b.part, t)) addFree(closest, false, onB.tangent, -closest.between.dot(onB.second));
  return closest;
}

/// Arc a against a point, segment or triangle.
ClosestArcs betweenArcAndSimplex(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset, ArcPlaces& places) {
  const SimplexPair pair = pairWithPoint(b.part->kind);
  geometry::Corners corners;
  corners.rightCols<3>() = b.corners;
  geometry::ClosestPoints onSimplex;
  ClosedCurve::Point onA;
  double last = std::numeric_limits<double>::quiet_NaN();
  // Tangents of the simplex at its closest point, and the part of the curve's tangent across them.
  Eigen::Matrix<double, 3, 2> tangents;
  const auto derivativesAt = [&](double s) -> Derivatives {
    onA = a.curve->at(last = s);
    corners.col(0) = onA.place + offset;
    onSimplex = geometry::closestPoints(pair, corners);
    const Vector3d between = corners * onSimplex.weights;
    tangents = -b.corners * onSimplex.slopes.bottomRows<3>();
    Vector3d across = onA.tangent;
    if (onSimplex.parameterCount == 1)
      across -= tangents.col(0) * (tangents.col(0).dot(across) / tangents.col(0).squaredNorm());
    if (onSimplex.parameterCount == 2) {
      const Vector3d normal = tangents.col(0).cross(tangents.col(1)).normalized();
      across = normal * normal.dot(across);
    }
    return {between.dot(onA.tangent), across.squaredNorm() + between.dot(onA.second)};
  };
  // The distance along an arc can have a minimum at each end: starting from the nearest of three points is enough,
  // since an arc is shorter than what it could bend around.
  double start = a.part->begin, nearest = std::numeric_limits<double>::infinity();
  for (const double s : {a.part->begin, 0.5 * (a.part->begin + a.part->end), a.part->end}) {
    derivativesAt(s);
    if (onSimplex.squaredDistance < nearest) nearest = onSimplex.squaredDistance, start = s;
  }
  const double s = minimumOnInterval(a.part->begin, a.part->end, start, derivativesAt);
  if (s != last) derivativesAt(s);
  ClosestArcs closest{corners * onSimplex.weights, onA.place, -(b.corners * onSimplex.weights.tail<3>())};
  if (isInside(*a.part, s)) addFree(closest, true, onA.tangent, closest.between.dot(onA.second));
  places.parameterA = s;
  places.weights = -onSimplex.weights.tail<3>();
  for (int k = 0; k < onSimplex.parameterCount; ++k) {
    places.slopes.col(closest.freeCount) = -onSimplex.slopes.col(k).tail<3>();
    addFree(closest, false, tangents.col(k), 0);
  }
  return closest;
}

ClosestArcs swapped(ClosestArcs closest) {
  closest.between = -closest.between;
  std::swap(closest.armA, closest.armB);
  for (bool& ofA : closest.ofA) ofA = !ofA;
  return closest;
}

}  // namespace

ClosestArcs closestArcs(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset, ArcPlaces& places) {
  if (a.part->kind != PartKind::arc) {
    ClosestArcs closest = swapped(betweenArcAndSimplex(b, a, -offset, places));
    std::swap(places.parameterA, places.parameterB);
    return closest;
  }
  if (b.part->kind != PartKind::arc) return betweenArcAndSimplex(a, b, offset, places);
  return betweenArcs(a, b, offset, places);
}

ClosestArcs closestArcs(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset) {
  ArcPlaces places;
  return closestArcs(a, b, offset, places);
}

bool areApart(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset, double distance) {
  if (a.part->kind != PartKind::arc) return b.part->kind == PartKind::arc && areApart(b, a, -offset, distance);
  const Vector3d middle = 0.5 * (a.corners.col(0) + a.corners.col(1)) + offset;
  const double half = 0.5 * a.part->chord + a.part->sagitta;
  if (b.part->kind != PartKind::arc) {
    const geometry::Corners corners = (geometry::Corners() << middle, b.corners).finished();
    const double far = distance + half;
    return geometry::closestPoints(pairWithPoint(b.part->kind), corners).squaredDistance >= far * far;
  }
  const double farBalls = distance + half + 0.5 * b.part->chord + b.part->sagitta;
  if ((middle - 0.5 * (b.corners.col(0) + b.corners.col(1))).squaredNorm() >= farBalls * farBalls) return true;
  const geometry::Corners chords =
      (geometry::Corners() << a.corners.leftCols<2>().colwise() + offset, b.corners.leftCols<2>()).finished();
  const double far = distance + a.part->sagitta + b.part->sagitta;
  return geometry::closestPoints(SimplexPair::edgeEdge, chords).squaredDistance >= far * far;
}

SimplexParts simplexParts(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset) {
  SimplexParts parts;
  // A point comes first, and an edge before a triangle does not occur.
  parts.swapped = a.part->kind > b.part->kind;
  const Eigen::Matrix3d cornersA = a.corners.colwise() + offset;
  const Eigen::Matrix3d& first = parts.swapped ? b.corners : cornersA;
  const Eigen::Matrix3d& second = parts.swapped ? cornersA : b.corners;
  if (std::min(a.part->kind, b.part->kind) == PartKind::segment) {
    parts.kind = SimplexPair::edgeEdge;
    parts.corners << first.leftCols<2>(), second.leftCols<2>();
  } else {
    parts.kind = pairWithPoint(std::max(a.part->kind, b.part->kind));
    parts.corners << first.col(0), second;
  }
  return parts;
}

double gapBetween(const PlacedPart& a, const PlacedPart& b, const Vector3d& offset) {
  const double radii = a.part->radius + b.part->radius;
  if (a.part->kind == PartKind::arc || b.part->kind == PartKind::arc)
    return closestArcs(a, b, offset).distance() - radii;
  const SimplexParts parts = simplexParts(a, b, offset);
  return std::sqrt(geometry::closestPoints(parts.kind, parts.corners).squaredDistance) - radii;
}

}  // namespace pliant::interlock
