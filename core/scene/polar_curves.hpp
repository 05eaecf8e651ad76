#pragma once

#include <string>
#include <vector>

#include "core/scene/bending_result.hpp"

namespace pliant::scene {

/// A quantity over the directions of the plane.
struct PolarCurve {
  std::string name;
  std::vector<double> angles;     ///< [rad], ascending within half a turn, or a whole one
  std::vector<double> values;     ///< one an angle; NaN where there is none
  std::vector<double> uncertain;  ///< how far a value may be off, as known; empty: not told
  bool halfTurn = true;           ///< the same in opposite directions
  bool dashed = false;
  double width = 1;  ///< of its line, relative: where curves coincide the wider one is seen beside the other
};

/// Curves with one unit, such as deformation limits (thesis Figs. 4.6, 4.7): limits of stretch and of compression, or
/// of curvature of either sign along and across the direction of bending. Values may be negative.
struct PolarCurves {
  std::string title;
  std::string unit;   ///< "%", "1/m"; empty: none
  double factor = 1;  ///< a value times this is in the unit
  int decimals = 2;   ///< that read-outs show
  std::vector<PolarCurve> curves;
  std::string note = {};  ///< below the legend; empty: none
};

/// Limits of stretch and of compression and the free travel between them, in per cent; without a limit where none was
/// found.
PolarCurves freeTravelCurves(const FreeTravelResult& result);

/// Limits of curvature along directions, up and down, and the curvatures across that the patch takes on there, in 1/m
/// (thesis Fig. 4.6); without a value where the patch folds. Where it is bent down both have the opposite sign, so that
/// limits up and down compare, and a value across below 0 is that of a saddle either way.
PolarCurves curvatureLimitCurves(const CurvatureLimitsResult& result);

}  // namespace pliant::scene
