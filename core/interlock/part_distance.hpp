#pragma once

#include "core/geometry/simplex_distance.hpp"
#include "core/interlock/element_parts.hpp"

namespace pliant::interlock {

/// A part in space, with the curves and corners of its element turned but not moved: all places are arms from the
/// element's origin.
struct PlacedPart {
  const Part* part;
  const ClosedCurve* curve;  ///< of an arc, turned; else null
  Eigen::Matrix3d corners;   ///< columns: corners, or the ends of an arc [m]
};

/// The closest points of two parts, at least one of them an arc: X_A - X_B = origin_A - origin_B + armA - armB.
struct ClosestArcs {
  Eigen::Vector3d between;     ///< X_A - X_B [m]
  Eigen::Vector3d armA, armB;  ///< from the elements' origins [m]
  /// Parameters u along which the closest points are free to slide: 0 to 3. For each, whether it belongs to A, the
  /// derivative of that arm and ∂²f/∂u² - |tangent|² of f = ½|X_A - X_B|², which is not 0 for curves.
  int freeCount = 0;
  std::array<bool, 3> ofA{};
  Eigen::Matrix3d tangents = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();

  double distance() const { return between.norm(); }
};

/// `offset` is origin_A - origin_B [m]. Finds a local minimum, which is the only one where both parts turn little and
/// are nearer to each other than their curvature radii.
ClosestArcs closestArcs(const PlacedPart& a, const PlacedPart& b, const Eigen::Vector3d& offset);

/// True only if the parts are at least `distance` apart [m], not counting their radii; cheap, and nearly always true
/// then if one of them is an arc.
bool areApart(const PlacedPart& a, const PlacedPart& b, const Eigen::Vector3d& offset, double distance);

/// Two parts that are both simplices, with corners relative to B's origin.
struct SimplexParts {
  geometry::SimplexPair kind;
  geometry::Corners corners;
  bool swapped;  ///< the first simplex is B's
};
SimplexParts simplexParts(const PlacedPart& a, const PlacedPart& b, const Eigen::Vector3d& offset);

/// The distance of any two parts that count as contact, less their radii [m].
double gapBetween(const PlacedPart& a, const PlacedPart& b, const Eigen::Vector3d& offset);

}  // namespace pliant::interlock
