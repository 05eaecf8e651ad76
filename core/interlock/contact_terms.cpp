#include "core/interlock/contact_terms.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "core/interlock/contact_motion.hpp"
#include "core/mechanics/contact_element.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Jacobian = ContactJacobian;

}  // namespace

bool ContactTerms::compute(const PlacedPart& partA, const PlacedPart& partB, const Vector3d& between,
                           const Eigen::Vector2d& translation, const CellContact::Barrier& barrier, bool wantGradient,
                           bool wantHessian) {
  a = &partA;
  b = &partB;
  offset = between;
  const bool arcs = partA.part->kind == PartKind::arc || partB.part->kind == PartKind::arc;
  const bool near = arcs ? computeArcs(translation, barrier, wantGradient, wantHessian)
                         : computeSimplices(translation, barrier, wantGradient, wantHessian);
  if (near && gap > 0 && wantHessian && force > barrier.largestForce) hessian *= barrier.largestForce / force;
  return near;
}

/// f(q, u) = ½|X_A - X_B|², D = min_u f: ∇D = f_q, ∇²D = f_qq - f_qu f_uu⁻¹ f_uq, of which d = sqrt(2D).
bool ContactTerms::computeArcs(const Eigen::Vector2d& translation, const CellContact::Barrier& barrier,
                               bool wantGradient, bool wantHessian) {
  const ClosestArcs closest = closestArcs(*a, *b, offset);
  const double distance = closest.distance();
  gap = distance - a->part->radius - b->part->radius;
  if (!(gap < barrier.range)) return false;
  if (!(gap > 0)) return true;
  const mechanics::BarrierFunction function(gap, barrier.range);
  const double scale = barrier.weight / (barrier.range * barrier.range);
  value = scale * function.value;
  force = -scale * function.slope;
  normal = closest.between / distance;
  place = closest.armA - (a->part->radius + 0.5 * gap) * normal;
  if (!wantGradient && !wantHessian) return true;

  const Jacobian jacobian = contactJacobian(closest.armA, closest.armB, translation);
  const Vector ofDistance = jacobian.transpose() * normal;
  gradient = -force * ofDistance;
  if (!wantHessian) return true;

  const Vector3d& between = closest.between;
  hessian = jacobian.transpose().lazyProduct(jacobian);
  hessian.block<3, 3>(3, 3) += rotationTerm(between, closest.armA);
  hessian.block<3, 3>(9, 9) -= rotationTerm(between, closest.armB);
  if (const int free = closest.freeCount; free > 0) {
    Eigen::Matrix<double, 15, Eigen::Dynamic, 0, 15, 3> mixed(15, free);
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> slides(3, free);
    for (int k = 0; k < free; ++k) slides.col(k) = (closest.ofA[k] ? 1 : -1) * closest.tangents.col(k);
    mixed.noalias() = jacobian.transpose() * slides;
    for (int k = 0; k < free; ++k) {
      const Vector3d turning = closest.tangents.col(k).cross(between);
      if (closest.ofA[k])
        mixed.block<3, 1>(3, k) += turning;
      else
        mixed.block<3, 1>(9, k) -= turning;
    }
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> inner = slides.transpose() * slides;
    for (int k = 0; k < free; ++k) inner(k, k) += closest.bend[k];
    // At a minimum this is not negative; where it is nearly singular, as between parallel curves, its inverse is
    // bounded so that rounding does not decide.
    const Eigen::SelfAdjointEigenSolver<decltype(inner)> solver(inner);
    const auto inverse = solver.eigenvalues().cwiseMax(1e-10 * inner.trace()).cwiseInverse();
    const Eigen::Matrix<double, 15, Eigen::Dynamic, 0, 15, 3> along = mixed * solver.eigenvectors();
    hessian.noalias() -= along * inverse.asDiagonal() * along.transpose();
  }
  const double curvature = scale * function.curvature;
  hessian = (-force / distance) * hessian + (curvature + force / distance) * ofDistance * ofDistance.transpose();
  return true;
}

bool ContactTerms::computeSimplices(const Eigen::Vector2d& translation, const CellContact::Barrier& barrier,
                                    bool wantGradient, bool wantHessian) {
  const SimplexParts parts = simplexParts(*a, *b, offset);
  const auto closest = geometry::closestPoints(parts.kind, parts.corners);
  gap = std::sqrt(closest.squaredDistance) - a->part->radius - b->part->radius;
  if (!(gap < barrier.range)) return false;
  if (!(gap > 0)) return true;
  mechanics::ContactElement element{
      parts.corners, closest, gap, barrier.weight / (barrier.range * barrier.range), barrier.range, 0};
  if (parts.kind == geometry::SimplexPair::edgeEdge)
    element.mollifierScale = geometry::edgeMollifierScale(parts.corners);  // lengths never change
  value = element.value();
  force = element.force().norm();
  const double sign = parts.swapped ? -1 : 1;
  normal = sign * geometry::directionBetween(parts.corners, closest);
  place = 0.5 * parts.corners * closest.weights.cwiseAbs() - offset;
  if (!wantGradient && !wantHessian) return true;

  // Seen from B's origin, A's corners are offset + arm, B's their arms alone.
  const int firstCount = geometry::firstCornerCount(parts.kind), count = geometry::cornerCount(parts.kind);
  std::array<Jacobian, 4> jacobians;
  std::array<Vector3d, 4> arms;
  std::array<bool, 4> ofA{};
  for (int i = 0; i < count; ++i) {
    ofA[i] = (i < firstCount) != parts.swapped;
    arms[i] = ofA[i] ? Vector3d(parts.corners.col(i) - offset) : Vector3d(parts.corners.col(i));
    jacobians[i].setZero();
    jacobians[i].block<3, 3>(0, ofA[i] ? 3 : 9) = -crossMatrix(arms[i]);
    if (!ofA[i]) continue;
    jacobians[i].block<3, 3>(0, 0).setIdentity();
    jacobians[i].block<3, 3>(0, 6) = -Matrix3d::Identity();
    jacobians[i].block<3, 3>(0, 12) = strainColumns(translation);
  }
  const geometry::CornerVector ofCorners = element.gradient();
  gradient.setZero();
  for (int i = 0; i < count; ++i) gradient += jacobians[i].transpose() * ofCorners.segment<3>(3 * i);
  if (!wantHessian) return true;
  const geometry::CornerMatrix second = element.hessian(0);
  hessian.setZero();
  for (int i = 0; i < count; ++i) {
    Jacobian row = Jacobian::Zero();
    for (int j = 0; j < count; ++j) row += second.block<3, 3>(3 * i, 3 * j).lazyProduct(jacobians[j]);
    hessian += jacobians[i].transpose().lazyProduct(row);
    const int turn = ofA[i] ? 3 : 9;
    hessian.block<3, 3>(turn, turn) += rotationTerm(ofCorners.segment<3>(3 * i), arms[i]);
  }
  return true;
}

}  // namespace pliant::interlock
