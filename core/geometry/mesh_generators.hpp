#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// A rectangle length x width [m] in the plane z = 0, along x from 0 and centred in y, of lengthCells x widthCells
/// cells of two triangles with alternating diagonals. Groups: "start" (x = 0), "end" (x = length), "left" (y = width/2)
/// and "right" (y = -width/2). Throws base::InputError unless lengths are above 0 and there are 1 to 2 million cells.
SurfaceMesh makeGrid(double length, double width, int lengthCells, int widthCells);

/// A narrow grid, one or two cells wide as a rule: the same with groups "start" and "end" alone. Hinge bending wants
/// cells at least as long as wide (see mechanics::makeHingeBending).
SurfaceMesh makeStrip(double length, double width, int lengthCells, int widthCells);

/// The tuning-fork outline of thesis Fig. 2.2: a handle along x from 0, a crossbar as deep as the handle is wide, and
/// two parallel prongs, in the plane z = 0 and mirrored in y = 0. All lengths in metres. One lattice of cells of two
/// triangles runs through all parts, bent within the crossbar where the spacing is no whole number of cells.
/// Groups: "base" (the handle's free end), "left_tip" (y > 0) and "right_tip" (the prongs' ends).
struct ForkShape {
  double handleLength = 0;  ///< from the free end to the crossbar
  double prongLength = 0;   ///< from the crossbar to the tips
  double width = 0;         ///< of the handle and of each prong
  double spacing = 0;       ///< between the centre lines of the prongs
  int handleCells = 0;
  int prongCells = 0;
  int widthCells = 0;
};
/// 188 triangles and 144 points for 13 handle, 14 prong and 2 width cells with a spacing of twice the width.
/// Throws base::InputError if a length or a number of cells is not positive, or the prongs are too close for a gap at
/// least half a cell wide.
SurfaceMesh makeFork(const ForkShape& shape);

}  // namespace pliant::geometry
