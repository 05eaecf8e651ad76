#pragma once

#include "core/scene/boundary_surface.hpp"
#include "core/scene/macro_result.hpp"

namespace pliant::scene {

/// Components (xx, yy, xy) of strains given as (mean, deviator, shear), a column each.
Eigen::Matrix3Xd tensorComponents(const Eigen::Matrix3Xd& strains);

/// Which of a sheet's limits.
enum class SheetLimit { stretch, bending };

/// The strains that the material of a sheet's triangle can reach, as they are looked at, without quantities; null if it
/// has no such limit.
std::shared_ptr<const BoundarySurface> materialBoundary(const MacroResult& result, SheetLimit limit, int triangle);

/// Which triangles are of the same material as this one.
std::vector<int> trianglesLike(const MacroResult& result, int triangle);

/// What the triangles of a sheet do at one moment.
struct SheetMoment {
  mechanics::SheetStrains strains;
  Eigen::VectorXd stretchGauge, bendingGauge;  ///< per triangle: 1 at the limit; 0 without one
};

/// In the frame with this number; where there is none in the last state.
SheetMoment sheetMoment(const MacroResult& result, int frame = -1);

/// Where these triangles stand in that space: 3 x triangles.
Eigen::Matrix3Xd strainPlaces(const SheetMoment& moment, SheetLimit limit, const std::vector<int>& triangles);

/// How far the nodes under loads have moved, at most [m]; without loads the node that has moved farthest.
double largestDeflection(const MacroResult& result);

}  // namespace pliant::scene
