#pragma once

#include <optional>

#include "core/mechanics/shell.hpp"
#include "core/mechanics/solid.hpp"

namespace pliant::mechanics {

/// Largest principal stretch of each triangle in its plane (1: unstretched): the larger singular value of the
/// deformation gradient from `restPositions` to `positions` (both of all coordinates [m], 2 or 3 dimensions).
Vector principalStretches(int dimension, const Vector& restPositions, const Vector& positions,
                          const Triangles& triangles);

/// Likewise of each tetrahedron, in 3 dimensions: the largest singular value.
Vector principalStretches(const Vector& restPositions, const Vector& positions, const Tetrahedra& tetrahedra);

/// Largest principal stretch minus 1 of any triangle or tetrahedron of the model's parts at `positions` (of all
/// coordinates [m]). None if it has neither, or is of 1 dimension.
std::optional<double> largestStrain(const Model& model, const Vector& positions);

}  // namespace pliant::mechanics
