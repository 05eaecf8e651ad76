#pragma once

#include "core/mechanics/shell.hpp"

namespace pliant::mechanics {

/// Largest principal stretch of each triangle in its plane (1: unstretched): the larger singular value of the
/// deformation gradient from `restPositions` to `positions` (both of all coordinates [m], 2 or 3 dimensions).
Vector principalStretches(int dimension, const Vector& restPositions, const Vector& positions,
                          const Triangles& triangles);

}  // namespace pliant::mechanics
