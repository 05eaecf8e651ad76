#include "core/geometry/simplex_distance.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <utility>

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;

/// Squared sine of the angle below which edges count as parallel, and triangles as their sides.
constexpr double parallelSquaredSine = 1e-20;
/// Below this, rounding in the parameters may cost more than going to an end or a side: the closer of both is right.
constexpr double doubtfulSquaredSine = 1e-6;

/// Point p against the edge of a and b. `sign` is 1 if p belongs to the first simplex, -1 if the edge does.
ClosestPoints closestOnEdge(const Corners& corners, int p, int a, int b, double sign) {
  ClosestPoints closest;
  const Vector3d edge = corners.col(b) - corners.col(a), toPoint = corners.col(p) - corners.col(a);
  const double along = edge.dot(toPoint), squaredLength = edge.squaredNorm();
  closest.weights[p] = sign;
  if (along <= 0) {
    closest.weights[a] = -sign;
    closest.squaredDistance = toPoint.squaredNorm();
  } else if (along >= squaredLength) {
    closest.weights[b] = -sign;
    closest.squaredDistance = (corners.col(p) - corners.col(b)).squaredNorm();
  } else {
    const double s = along / squaredLength;
    closest.weights[a] = -sign * (1 - s);
    closest.weights[b] = -sign * s;
    closest.parameterCount = 1;
    closest.slopes(a, 0) = sign;
    closest.slopes(b, 0) = -sign;
    closest.squaredDistance = (toPoint - s * edge).squaredNorm();
  }
  return closest;
}

void keepCloser(const ClosestPoints& other, ClosestPoints& closest) {
  if (other.squaredDistance < closest.squaredDistance) closest = other;
}

ClosestPoints closestOnTriangle(const Corners& corners) {
  const Vector3d ab = corners.col(2) - corners.col(1), ac = corners.col(3) - corners.col(1);
  const Vector3d ap = corners.col(0) - corners.col(1), normal = ab.cross(ac);
  const double squaredNormal = normal.squaredNorm(), product = ab.squaredNorm() * ac.squaredNorm();
  ClosestPoints inner;
  inner.squaredDistance = std::numeric_limits<double>::infinity();
  if (squaredNormal > parallelSquaredSine * product) {
    const double s = ap.cross(ac).dot(normal) / squaredNormal, t = ab.cross(ap).dot(normal) / squaredNormal;
    if (s > 0 && t > 0 && s + t < 1) {
      inner.parameterCount = 2;
      inner.weights << 1, s + t - 1, -s, -t;
      inner.slopes << 0, 0, 1, 1, -1, 0, 0, -1;
      inner.squaredDistance = (ap - s * ab - t * ac).squaredNorm();
      if (squaredNormal > doubtfulSquaredSine * product) return inner;
    }
  }
  ClosestPoints closest = closestOnEdge(corners, 0, 1, 2, 1);
  keepCloser(closestOnEdge(corners, 0, 2, 3, 1), closest);
  keepCloser(closestOnEdge(corners, 0, 3, 1, 1), closest);
  keepCloser(inner, closest);
  return closest;
}

ClosestPoints closestOfEdges(const Corners& corners) {
  const Vector3d a = corners.col(1) - corners.col(0), b = corners.col(3) - corners.col(2);
  const Vector3d between = corners.col(2) - corners.col(0), normal = a.cross(b);
  const double squaredNormal = normal.squaredNorm(), product = a.squaredNorm() * b.squaredNorm();
  ClosestPoints inner;
  inner.squaredDistance = std::numeric_limits<double>::infinity();
  if (squaredNormal > parallelSquaredSine * product) {
    // Where the edges are nearly parallel, an error in s matters little as long as t belongs to it.
    const double s = between.cross(b).dot(normal) / squaredNormal, t = (s * a - between).dot(b) / b.squaredNorm();
    if (s > 0 && s < 1 && t > 0 && t < 1) {
      inner.parameterCount = 2;
      inner.weights << 1 - s, s, t - 1, -t;
      inner.slopes << -1, 0, 1, 0, 0, 1, 0, -1;
      inner.squaredDistance = (s * a - t * b - between).squaredNorm();
      if (squaredNormal > doubtfulSquaredSine * product) return inner;
    }
  }
  ClosestPoints closest = closestOnEdge(corners, 0, 2, 3, 1);
  keepCloser(closestOnEdge(corners, 1, 2, 3, 1), closest);
  keepCloser(closestOnEdge(corners, 2, 0, 1, -1), closest);
  keepCloser(closestOnEdge(corners, 3, 0, 1, -1), closest);
  keepCloser(inner, closest);
  return closest;
}

/// r and dr/du.
std::pair<Vector3d, Eigen::Matrix<double, 3, 2>> differenceAndTangents(const Corners& corners,
                                                                       const ClosestPoints& closest) {
  Vector3d difference = Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
  for (int i = 0; i < 4; ++i) {
    if (closest.weights[i] == 0) continue;  // columns that are not used may hold anything, even NaN
    difference += closest.weights[i] * corners.col(i);
    tangents += corners.col(i) * closest.slopes.row(i);
  }
  return {difference, tangents};
}

}  // namespace

ClosestPoints closestPoints(SimplexPair pair, const Corners& corners) {
  switch (pair) {
    case SimplexPair::pointEdge: return closestOnEdge(corners, 0, 1, 2, 1);
    case SimplexPair::pointTriangle: return closestOnTriangle(corners);
    case SimplexPair::edgeEdge: return closestOfEdges(corners);
    case SimplexPair::pointPoint: break;
  }
  ClosestPoints closest;
  closest.weights << 1, -1, 0, 0;
  closest.squaredDistance = (corners.col(0) - corners.col(1)).squaredNorm();
  return closest;
}

Eigen::Vector3d directionBetween(const Corners& corners, const ClosestPoints& closest) {
  auto [difference, tangents] = differenceAndTangents(corners, closest);
  if (closest.parameterCount == 2) {
    const Vector3d normal = tangents.col(0).cross(tangents.col(1));
    return normal.normalized() * (normal.dot(difference) < 0 ? -1 : 1);
  }
  if (closest.parameterCount == 1)
    difference -= tangents.col(0) * (tangents.col(0).dot(difference) / tangents.col(0).squaredNorm());
  return difference.normalized();
}

void squaredDistanceDerivatives(const Corners& corners, const ClosestPoints& closest, CornerVector* gradient,
                                CornerMatrix* hessian) {
  const auto [difference, tangents] = differenceAndTangents(corners, closest);
  if (gradient)
    for (int i = 0; i < 4; ++i) gradient->segment<3>(3 * i) = 2 * closest.weights[i] * difference;
  if (!hessian) return;

  hessian->setZero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      hessian->block<3, 3>(3 * i, 3 * j).diagonal().setConstant(2 * closest.weights[i] * closest.weights[j]);
  if (closest.parameterCount == 0) return;
  // Halves of f_xu, and of f_uu, whose determinant as a cross product does not suffer from cancellation.
  Eigen::Matrix<double, 12, 2> mixed;
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 4; ++i)
      mixed.block<3, 1>(3 * i, k) = closest.weights[i] * tangents.col(k) + closest.slopes(i, k) * difference;
  if (closest.parameterCount == 1) {
    *hessian -= (2 / tangents.col(0).squaredNorm()) * mixed.col(0) * mixed.col(0).transpose();
  } else {
    Eigen::Matrix2d inverse;
    inverse << tangents.col(1).squaredNorm(), -tangents.col(0).dot(tangents.col(1)), 0, tangents.col(0).squaredNorm();
    inverse(1, 0) = inverse(0, 1);
    inverse *= 2 / tangents.col(0).cross(tangents.col(1)).squaredNorm();
    *hessian -= mixed * inverse * mixed.transpose();
  }
}

double edgeMollifierScale(const Corners& rest) {
  return 1e-3 * (rest.col(1) - rest.col(0)).squaredNorm() * (rest.col(3) - rest.col(2)).squaredNorm();
}

double edgeMollifier(const Corners& corners, double scale, CornerVector* gradient, CornerMatrix* hessian) {
  const Vector3d a = corners.col(1) - corners.col(0), b = corners.col(3) - corners.col(2);
  const double ratio = a.cross(b).squaredNorm() / scale;
  if (!(ratio < 1)) {
    if (gradient) gradient->setZero();
    if (hessian) hessian->setZero();
    return 1;
  }
  if (gradient || hessian) {
    // By a and b: c = |a|²|b|² - (a·b)².
    const double product = a.dot(b), slope = 2 * (1 - ratio) / scale;
    Eigen::Matrix<double, 6, 1> first;
    first.head<3>() = 2 * (b.squaredNorm() * a - product * b);
    first.tail<3>() = 2 * (a.squaredNorm() * b - product * a);
    Eigen::Matrix<double, 6, 12> toEdges = Eigen::Matrix<double, 6, 12>::Zero();
    toEdges.block<3, 3>(0, 0).diagonal().setConstant(-1);
    toEdges.block<3, 3>(0, 3).diagonal().setConstant(1);
    toEdges.block<3, 3>(3, 6).diagonal().setConstant(-1);
    toEdges.block<3, 3>(3, 9).diagonal().setConstant(1);
    if (gradient) *gradient = slope * (toEdges.transpose() * first);
    if (hessian) {
      Eigen::Matrix<double, 6, 6> second;
      const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
      second.block<3, 3>(0, 0) = 2 * (b.squaredNorm() * identity - b * b.transpose());
      second.block<3, 3>(3, 3) = 2 * (a.squaredNorm() * identity - a * a.transpose());
      second.block<3, 3>(0, 3) = 4 * a * b.transpose() - 2 * b * a.transpose() - 2 * product * identity;
      second.block<3, 3>(3, 0) = second.block<3, 3>(0, 3).transpose();
      second = (slope * second - (2 / (scale * scale)) * first * first.transpose()).eval();
      *hessian = toEdges.transpose() * second * toEdges;
    }
  }
  return (2 - ratio) * ratio;
}

}  // namespace pliant::geometry
