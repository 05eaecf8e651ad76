#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// A number that every limit of a boundary has.
struct BoundaryQuantity {
  enum class Kind {
    coordinate,  ///< shown in the unit of the space
    number,
    count,
    way  ///< 0: straight from the middle, 1: raised by a neighbour, 2: the set is not star-shaped there
  };
  std::string key;    ///< "distance", "remaining", "gap", "contacts", "iterations", "way"
  std::string label;  ///< for people
  Kind kind = Kind::number;
  Eigen::VectorXd values;  ///< one a point; NaN where no limit is known
};

/// A boundary as it is looked at: a closed surface of limits in Green strain, or in curvature, or as much of it as
/// there is.
struct BoundarySurface {
  std::string name;
  BoundarySpace space = strainSpace();
  Eigen::Matrix3Xd points;                    ///< coordinates of the limits
  std::vector<std::array<int, 3>> triangles;  ///< counterclockwise from outside, all whose corners have a place
  /// Whether a limit is known there. Other points lie between the two that their direction is between, if those have a
  /// place.
  std::vector<bool> known;
  std::vector<BoundaryQuantity> quantities;  ///< what there is of them

  int knownCount() const;
  /// Null if there is none.
  const BoundaryQuantity* quantity(const std::string& key) const;
};

/// Distances are in strain or curvature, from the middle; gaps in smallest radii.
BoundarySurface boundarySurface(const LimitSurface& limits, const std::string& name);

/// What a `stretch_boundary` or `bending_boundary` study wrote: the folder of its result, or the file boundary.ply in
/// it or from anywhere. Without boundary.csv beside it the surface has no quantities, and seven digits, and is taken
/// for one in Green strain. Throws base::InputError.
BoundarySurface readBoundarySurface(const std::filesystem::path& place);

/// What a strain means: stretches along two directions at right angles, the larger first.
struct PrincipalStretch {
  double larger = 1, smaller = 1;
  double angle = 0;  ///< of the larger [rad], in (-π/2, π/2]
};
/// Of Green strain E = (FᵀF - I)/2.
PrincipalStretch principalStretch(const Eigen::Vector3d& greenStrain);

}  // namespace pliant::scene
