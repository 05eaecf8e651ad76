#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

struct RoundHole {
  Eigen::Vector2d centre;  ///< [m]
  double diameter = 0;     ///< [m]
};

/// The outline of a plate: all points within half of `width` of the convex hull of one of some sets of points (one
/// point: a disc; two: a slot's shape; more: a rounded polygon), less round holes [m].
struct PlateOutline {
  std::vector<std::vector<Eigen::Vector2d>> hulls;
  double width = 0;
  std::vector<RoundHole> holes;
};

/// The plate as a closed mesh from z = 0 to `thickness` [m]. Its round corners lie inside of the exact ones by at most
/// `tolerance` [m], and its holes outside of theirs, so that pins fit; corners nearer to each
/// other than 1 µm become one. Throws
/// base::InputError (location empty): a number that is not above 0, two holes that run into each other, a hole that
/// reaches the rim, an outline in several pieces.
SurfaceMesh makePlate(const PlateOutline& outline, double thickness, double tolerance);

/// The least distance between two plates in the plane, holes left out [m]; 0 if they overlap.
double distanceBetween(const PlateOutline& a, const PlateOutline& b);

}  // namespace pliant::geometry
