#pragma once

#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// A rectangle length x width [m] in the plane z = 0, along x from 0 and centred in y, of lengthCells x widthCells cells
/// of two triangles with alternating diagonals. Groups: "start" (x = 0), "end" (x = length), "left" and "right" (y = ±width/2).
SurfaceMesh makeGrid(double length, double width, int lengthCells, int widthCells);

/// A grid one or two cells wide: the same with groups "start" and "end".
SurfaceMesh makeStrip(double length, double width, int lengthCells, int widthCells);

/// The tuning-fork outline of thesis Fig. 2.2: a handle along x that branches into two parallel prongs, in the plane
/// z = 0. All lengths in metres. Groups: "base" (the handle's free end), "left_tip", "right_tip" (the prongs' ends).
struct ForkShape {
  double handleLength = 0;
  double prongLength = 0;
  double width = 0;    ///< of the handle and of each prong
  double spacing = 0;  ///< between the centre lines of the prongs
  int handleCells = 0;
  int prongCells = 0;
  int widthCells = 0;
};
SurfaceMesh makeFork(const ForkShape& shape);

}  // namespace pliant::geometry
