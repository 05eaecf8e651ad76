#pragma once

#include "core/interlock/unit_cell.hpp"

namespace pliant::interlock {

/// Which elements of a material belong to a finite patch: those whose origins at rest lie inside, or on the rim.
struct PatchOutline {
  enum class Kind { circle, rectangle };
  Kind kind = Kind::circle;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0;                                 ///< of a circle [m]
  Eigen::Vector2d size = Eigen::Vector2d::Zero();    ///< sides of a rectangle [m]
};

/// A finite patch of a material at rest, moved so that the mean of its elements' origins is (0, 0); elements are sorted
/// by cells, rows of the second lattice vector fastest. Throws base::InputError (location empty) if there are fewer
/// than two elements, more than 4000, or some that links do not connect with the others.
UnitCell cutPatch(const UnitCell& cell, const PatchOutline& outline);

/// For each pair of elements how many links lead from one to the other at least (n x n), -1 if none do.
Eigen::MatrixXi linkDistances(const UnitCell& patch);

/// Volume and centre of mass of a shape of uniform density, in its coordinates. Where pieces run into one another their
/// common volume counts for each. Wires are exact: a closed tube has the volume π r² L and the centroid of its centre
/// line (Pappus; the correction by curvature vanishes over a closed curve). Open rods and plates are exact for convex
/// ones (Steiner's formula), with the caps' volume spread over their rim.
struct BodyMass {
  double volume = 0;                                 ///< [m³]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
};
BodyMass bodyMass(const ElementShape& shape);

}  // namespace pliant::interlock
