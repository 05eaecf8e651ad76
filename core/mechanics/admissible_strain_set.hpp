#pragma once

#include <memory>

#include "core/geometry/surface_distance.hpp"

namespace pliant::mechanics {

/// A quantity of a strain with its derivatives.
struct StrainFunction {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// All strains that a material can reach: what a closed surface encloses (thesis 4.3.3). A strain is (mean, deviator,
/// shear) = ((s_xx + s_yy)/2, (s_xx - s_yy)/2, s_xy) of a symmetric tensor s, Green strain or curvature, in the
/// material's axes; axes turned by α turn (deviator, shear) by -2α. Any thread may ask.
class AdmissibleStrainSet {
 public:
  /// `boundary` has strains for points, triangles counterclockwise from outside; `middle` is a strain from which all of
  /// it is seen. Throws base::InputError (location empty) if it is not closed, or not seen from there.
  AdmissibleStrainSet(geometry::SurfaceMesh boundary, const Eigen::Vector3d& middle);

  const Eigen::Vector3d& middle() const { return middle_; }
  const geometry::SurfaceMesh& boundary() const { return distance_.mesh(); }
  /// The diagonal of the box around the boundary.
  double size() const { return distance_.box().diagonal().norm(); }

  /// Below 1 inside, 1 on the boundary, and homogeneous of degree 1 in s - middle: |s - middle| over the distance of
  /// the boundary in that direction. The logarithm of that distance is interpolated between the boundary's points by
  /// radial functions that are smooth and of compact support on the sphere of directions (Wendland 1995, C⁴), so that
  /// the gauge is exact there and smooth everywhere but at the middle; see gaugeError.
  StrainFunction gauge(const Eigen::Vector3d& strain, bool withDerivatives = true) const;
  /// How far from 1 the gauge is on the boundary between its points: in the middles of edges and triangles, whose own
  /// places are flat where the set's boundary need not be. The largest and the root mean square.
  struct GaugeError {
    double largest = 0, rootMeanSquare = 0;
  };
  const GaugeError& gaugeError() const { return gaugeError_; }

  /// From the boundary, over size(): above 0 outside (thesis 4.3.4).
  StrainFunction distance(const Eigen::Vector3d& strain) const;

 private:
  /// Wendland functions around directions; which of them reach where is looked up by cells of a cube around the sphere.
  void collectCells();
  int cellOf(const Eigen::Vector3d& direction) const;
  StrainFunction logarithm(const Eigen::Vector3d& direction, bool withDerivatives) const;

  geometry::SurfaceDistance distance_;
  Eigen::Vector3d middle_;
  Eigen::Matrix3Xd directions_;
  Eigen::VectorXd weights_;
  double meanLogarithm_ = 0;
  double support_ = 0;  ///< chord
  std::vector<std::vector<int>> cells_;
  GaugeError gaugeError_;
};

}  // namespace pliant::mechanics
