#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/interlock/boundary_file.hpp"
#include "core/interlock/strain_space_boundary.hpp"

namespace pliant::scene {

/// The space in which a boundary is looked at.
struct BoundarySpace {
  std::array<std::string, 3> axes;  ///< names of the coordinates
  std::string unit;                 ///< in which they are shown
  double factor = 1;                ///< a coordinate times this is in the unit
};
/// Green strain, in per cent: E_x, E_y, E_xy.
const BoundarySpace& strainSpace();
/// Curvature, in 1/m: k_xx, k_yy, k_xy.
const BoundarySpace& curvatureSpace();

/// The part of a result that is a closed surface of limits: of stretch, or of bending.
class LimitSurface {
 public:
  virtual ~LimitSurface() = default;
  virtual const BoundarySpace& space() const = 0;
  /// Where a strain of the boundary lies in that space.
  virtual Eigen::Vector3d coordinates(const Eigen::Vector3d& strain) const = 0;
  /// What is deformed: a cell, or a patch.
  virtual std::shared_ptr<const interlock::UnitCell> body() const = 0;
  /// What boundary.csv says: a row a limit.
  virtual std::string table() const = 0;

  interlock::StrainSpaceBoundary boundary;
  int recalled = 0;  ///< limits that a run before had found
  /// What a run after a cancelled one goes on from, see ResumableStudy.
  std::shared_ptr<interlock::KnownStates> memory;
};

}  // namespace pliant::scene
