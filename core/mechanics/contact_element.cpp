#include "core/mechanics/contact_element.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace pliant::mechanics {

namespace {

using geometry::CornerMatrix;
using geometry::CornerVector;

/// w ⊗ n: n times each of the weights.
CornerVector weighted(const Eigen::Vector4d& weights, const Eigen::Vector3d& n) {
  CornerVector product;
  for (int i = 0; i < 4; ++i) product.segment<3>(3 * i) = weights[i] * n;
  return product;
}

template <int size>
Eigen::Matrix<double, size, size> withConvexity(const Eigen::Matrix<double, size, size>& symmetric, double convexity) {
  if (convexity == 0) return symmetric;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, size, size>> solver(symmetric);
  const auto& values = solver.eigenvalues();
  return solver.eigenvectors() * (values - convexity * values.cwiseMin(0)).asDiagonal() *
         solver.eigenvectors().transpose();
}

/// slope ∇²d + curvature ∇d∇dᵀ for slope <= 0, with `free` free parameters and negative eigenvalues taken 1 - convexity
/// times. With the weights w, unit tangents t_k along which the closest points slide, and c_k the change of w for a
/// unit of length along t_k,
///   ∇d = w⊗n,  ∇²d = wwᵀ⊗(I - nnᵀ - Σ t_k t_kᵀ)/d - Σ [(w⊗t_k)(c_k⊗n)ᵀ + its transpose] - d Σ (c_k⊗n)(c_k⊗n)ᵀ,
/// which is f_xx - f_xu f_uu⁻¹ f_ux of geometry::squaredDistanceDerivatives, sorted. Times the slope, the first term is
/// negative and perpendicular to all others; these live in the few dimensions of w, c_k times n and of w times t_k,
/// where eigenvalues cost a tenth of those of the 12 x 12 matrix.
template <int free>
CornerMatrix hessianOfPair(const geometry::Corners& corners, const geometry::ClosestPoints& closest,
                           const Eigen::Vector3d& n, double slope, double curvature, double convexity) {
  const double distance = std::sqrt(closest.squaredDistance);
  Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();  // I - nnᵀ - Σ t_k t_kᵀ, 0 if free == 2
  const auto addAcross = [&](CornerMatrix& hessian) {
    if (free == 2 || convexity == 1) return;
    across *= (1 - convexity) * slope / distance;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) hessian.block<3, 3>(3 * i, 3 * j) += closest.weights[i] * closest.weights[j] * across;
  };
  if constexpr (free == 0) {
    const CornerVector gradient = weighted(closest.weights, n);
    CornerMatrix hessian = curvature * gradient * gradient.transpose();
    addAcross(hessian);
    return hessian;
  } else {
    constexpr int size = 1 + 2 * free;
    const Eigen::Matrix<double, 4, free> slopes = closest.slopes.leftCols<free>();
    const Eigen::Matrix<double, 3, free> tangents = corners * slopes;
    // Orthonormal tangents t = tangents R⁻¹, by Gram and Schmidt; the slopes follow.
    Eigen::Matrix<double, 3, free> t = tangents;
    Eigen::Matrix<double, 4, 1 + free> base;
    base.col(0) = closest.weights;
    base.template rightCols<free>() = slopes;
    const double firstLength = t.col(0).norm();
    t.col(0) /= firstLength;
    base.col(1) /= firstLength;
    if constexpr (free == 2) {
      const double along = t.col(0).dot(t.col(1));
      t.col(1) = n.cross(t.col(0));
      const double height = t.col(1).dot(tangents.col(1));
      base.col(2) = (base.col(2) - along * base.col(1)) / height;
    }
    // [w c_1 c_2] = Q R.
    Eigen::Matrix<double, 4, 1 + free> q = base;
    Eigen::Matrix<double, 1 + free, 1 + free> r = Eigen::Matrix<double, 1 + free, 1 + free>::Zero();
    for (int j = 0; j <= free; ++j) {
      for (int pass = 0; pass < 2; ++pass)  // twice, for orthogonality to rounding
        for (int i = 0; i < j; ++i) {
          const double share = q.col(i).dot(q.col(j));
          r(i, j) += share;
          q.col(j) -= share * q.col(i);
        }
      r(j, j) = q.col(j).norm();
      q.col(j) /= r(j, j);
    }
    Eigen::Matrix<double, size, size> reduced = Eigen::Matrix<double, size, size>::Zero();
    reduced.template topLeftCorner<1 + free, 1 + free>() = curvature * r.col(0) * r.col(0).transpose();
    for (int k = 1; k <= free; ++k) {
      reduced.template topLeftCorner<1 + free, 1 + free>() -= slope * distance * r.col(k) * r.col(k).transpose();
      reduced.template block<1 + free, 1>(0, free + k) = -slope * r(0, 0) * r.col(k);
      reduced.template block<1, 1 + free>(free + k, 0) = reduced.template block<1 + free, 1>(0, free + k).transpose();
    }
    Eigen::Matrix<double, 12, size> basis;
    for (int j = 0; j <= free; ++j) basis.col(j) = weighted(q.col(j), n);
    for (int k = 0; k < free; ++k) basis.col(1 + free + k) = weighted(q.col(0), t.col(k));
    CornerMatrix hessian = basis * withConvexity<size>(reduced, convexity) * basis.transpose();
    across -= t * t.transpose();
    addAcross(hessian);
    return hessian;
  }
}

}  // namespace

BarrierFunction::BarrierFunction(double gap, double range) {
  if (!(gap < range)) return;
  const double ratio = range / gap, logarithm = -std::log(ratio), missing = range - gap;
  value = -missing * missing * logarithm;
  slope = missing * (2 * logarithm - ratio + 1);
  curvature = (ratio + 2) * ratio - 2 * logarithm - 3;
}

double ContactElement::mollifier(CornerVector* gradient, CornerMatrix* hessian) const {
  return geometry::edgeMollifier(corners, mollifierScale, gradient, hessian);
}

double ContactElement::value() const {
  const double fade = mollifierScale > 0 ? mollifier(nullptr, nullptr) : 1;
  return stiffness * fade * BarrierFunction(gap, range).value;
}

CornerVector ContactElement::gradient() const {
  const BarrierFunction barrier(gap, range);
  const CornerVector distance = weighted(closest.weights, geometry::directionBetween(corners, closest));
  if (mollifierScale == 0) return stiffness * barrier.slope * distance;
  CornerVector fadeGradient;
  const double fade = mollifier(&fadeGradient, nullptr);
  return stiffness * (barrier.value * fadeGradient + fade * barrier.slope * distance);
}

Eigen::Vector3d ContactElement::force() const {
  // The mollifier's own gradient turns each edge, but does not push it.
  const double fade = mollifierScale > 0 ? mollifier(nullptr, nullptr) : 1;
  return -stiffness * fade * BarrierFunction(gap, range).slope * geometry::directionBetween(corners, closest);
}

CornerMatrix ContactElement::hessian(double convexity) const {
  const BarrierFunction barrier(gap, range);
  const Eigen::Vector3d n = geometry::directionBetween(corners, closest);
  CornerVector fadeGradient;
  CornerMatrix fadeHessian;
  const double fade = mollifierScale > 0 ? mollifier(&fadeGradient, &fadeHessian) : 1;
  if (fade == 1) {
    const double slope = stiffness * barrier.slope, curvature = stiffness * barrier.curvature;
    if (closest.parameterCount == 2) return hessianOfPair<2>(corners, closest, n, slope, curvature, convexity);
    if (closest.parameterCount == 1) return hessianOfPair<1>(corners, closest, n, slope, curvature, convexity);
    return hessianOfPair<0>(corners, closest, n, slope, curvature, convexity);
  }
  const CornerVector distanceGradient = weighted(closest.weights, n);
  CornerMatrix hessian;
  geometry::squaredDistanceDerivatives(corners, closest, nullptr, &hessian);
  const double distance = std::sqrt(closest.squaredDistance);
  hessian = (0.5 * hessian - distanceGradient * distanceGradient.transpose()) / distance;  // of the distance
  const CornerMatrix mixed = fadeGradient * distanceGradient.transpose();
  hessian = (stiffness * (barrier.value * fadeHessian + barrier.slope * (mixed + mixed.transpose() + fade * hessian) +
                          fade * barrier.curvature * distanceGradient * distanceGradient.transpose()))
                .eval();
  return withConvexity<12>(hessian, convexity);
}

}  // namespace pliant::mechanics
