#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ui/render/points.hpp"

namespace pliant::render {

using TriangleList = std::vector<std::array<int, 3>>;

/// The outline of a body's shadow along an axis: `count` points about the shadow's middle, as coordinates along the
/// axes (axis + 1) % 3 and (axis + 2) % 3. The body must be seen whole from its middle, as boundaries are. Directions
/// in which it has no triangle give the middle itself.
Eigen::Matrix2Xd shadowOutline(const Points& points, const TriangleList& triangles, int axis, int count = 360);

/// Where a surface meets the plane x[axis] = position: its curves, the first point not repeated at the end of those
/// that are closed.
struct SliceCurve {
  Points points;
  bool closed = false;
};
std::vector<SliceCurve> sliceCurves(const Points& points, const TriangleList& triangles, int axis, double position);

/// Where a ray meets a surface first.
struct SurfaceHit {
  int triangle = -1;
  double distance = 0;      ///< in units of the direction's length
  Eigen::Vector3d weights;  ///< of the triangle's corners
};
std::optional<SurfaceHit> firstHit(const Points& points, const TriangleList& triangles, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction);

}  // namespace pliant::render
