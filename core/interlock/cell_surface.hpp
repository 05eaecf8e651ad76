#pragma once

#include "core/geometry/surface_mesh.hpp"
#include "core/interlock/cell_contact.hpp"

namespace pliant::interlock {

/// The surfaces of all pieces of a cell and of its images, `first` x `second` cells in all, for display: tubes, balls
/// and plates that may run into one another. Curves are cut into pieces that turn by at most `turn` [rad].
geometry::SurfaceMesh cellSurface(const UnitCell& cell, const CellState& state, int first, int second,
                                  double turn = 0.13);

}  // namespace pliant::interlock
