#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/mechanics/body_motion.hpp"
#include "core/mechanics/contact_barrier.hpp"

namespace pliant::mechanics {

/// Something that a sheet lies on.
struct Body {
  std::string name;
  Eigen::Matrix3Xd points;  ///< at rest [m]
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;  ///< of a capsule; with neither triangles nor edges the points are spheres
  double radius = 0;                      ///< of what is swept along points, edges and triangles [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Keyframe> path;
};

/// Of the points of all bodies at `time`, one body after the other (3 x points) [m].
Eigen::Matrix3Xd bodyPointsAt(const std::vector<Body>& bodies, double time);

/// A sheet and the bodies that it meets.
struct SheetContact {
  std::vector<std::array<int, 3>> triangles;  ///< of the sheet
  std::vector<Body> bodies;
  double distance = 1e-3;  ///< gap below which contact begins to push [m]
  bool selfContact = false;
};

/// The barrier between a sheet with nodes at `rest` (3 x n) [m] and bodies, whose points follow as its nodes, and if it
/// touches itself the sheet; null if there is neither. Half-way into the contact distance a pair pushes with ten times
/// `weight` [N], that of a node. Throws base::InputError (location empty) if the contact distance is not above 0.
std::shared_ptr<ContactBarrier> makeSheetContact(const SheetContact& contact, const Eigen::Matrix3Xd& rest,
                                                 double weight);

}  // namespace pliant::mechanics
