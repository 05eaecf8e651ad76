#pragma once

#include <memory>
#include <vector>

#include "core/mechanics/energy.hpp"
#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

class AdmissibleStrainSet;

/// What keeps the strains s of triangles in their admissible sets, an energy an area:
struct StrainLimitFunction {
  enum class Kind {
    barrier,  ///< -c ln(1 - (g / (1 - margin))²) with the set's gauge g: never violated
    penalty   ///< c d³ outside, with the distance d from the set over its size (thesis 4.3.5)
  };
  Kind kind = Kind::barrier;
  double coefficient = 1;  ///< c [J/m²]
  /// Of a barrier, below 1: strains stay within the set shrunk by this part about its middle, from where all of it is
  /// seen, so that the shrunk one is inside of it.
  double margin = 0;
};

/// A triangle of a sheet that is flat at rest, and the material's axes in it.
struct LimitedTriangle {
  std::array<int, 3> nodes{};
  Eigen::Matrix<double, 2, 3> rest;  ///< its corners in the material's axes, counterclockwise [m]
  std::shared_ptr<const AdmissibleStrainSet> stretch, bending;  ///< either may be null: no limit
};

/// Limits of Green strain, and of curvature (see StretchLimitElement and CurvatureLimitElement), in 3 dimensions. Null
/// if no triangle has any. Throws base::InputError for a triangle without area.
std::shared_ptr<const Energy> makeStretchLimit(const std::vector<LimitedTriangle>& triangles,
                                               const StrainLimitFunction& function);
std::shared_ptr<const Energy> makeCurvatureLimit(const std::vector<LimitedTriangle>& triangles,
                                                 const StrainLimitFunction& function);

/// Strains of all triangles at x, as (mean, deviator, shear): 3 x triangles.
struct SheetStrains {
  Eigen::Matrix3Xd stretch;    ///< Green strain
  Eigen::Matrix3Xd curvature;  ///< [1/m]
};
SheetStrains sheetStrains(const std::vector<LimitedTriangle>& triangles, const Vector& x);

}  // namespace pliant::mechanics
