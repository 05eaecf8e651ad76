#pragma once

#include "core/geometry/simplex_distance.hpp"

namespace pliant::mechanics {

/// The barrier of Li et al. 2020 ("Incremental potential contact", equation 6) over a gap 0 < g < range:
///   b(g) = -(g - range)² ln(g / range) [m²], 0 beyond, twice continuously differentiable.
struct BarrierFunction {
  double value = 0;      ///< b [m²]
  double slope = 0;      ///< b' [m], never positive
  double curvature = 0;  ///< b'', never negative

  BarrierFunction(double gap, double range);
};

/// The energy of one pair of primitives that are near each other: E = stiffness m b(d - offset), with the distance d
/// of the simplices and, of two edges, the mollifier m (1 for others).
struct ContactElement {
  geometry::Corners corners;        ///< [m]
  geometry::ClosestPoints closest;  ///< of these corners
  double gap = 0;                   ///< d - offset, above 0 [m]
  double stiffness = 0;             ///< [J/m²]
  double range = 0;                 ///< [m]
  double mollifierScale = 0;        ///< geometry::edgeMollifierScale at rest [m⁴]; 0: not two edges

  double value() const;                     ///< [J]
  geometry::CornerVector gradient() const;  ///< [N]
  Eigen::Vector3d force() const;            ///< on the first simplex [N]
  /// The Hessian with its negative eigenvalues taken 1 - convexity times [N/m]: 0 gives the Hessian itself, 1 the
  /// positive semidefinite matrix nearest to it in the Frobenius norm.
  geometry::CornerMatrix hessian(double convexity) const;

 private:
  double mollifier(geometry::CornerVector* gradient, geometry::CornerMatrix* hessian) const;
};

}  // namespace pliant::mechanics
