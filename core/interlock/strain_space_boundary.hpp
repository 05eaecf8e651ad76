#pragma once

#include <functional>
#include <map>
#include <mutex>

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/sphere_mesh.hpp"

namespace pliant::interlock {

struct BoundaryOptions {
  int subdivisions = 3;        ///< of the icosahedron: 642 rays
  double perturbation = 0.01;  ///< of the state at the middle, see LimitOptions
  unsigned seed = 1;
  /// Edges are cut where the surface is estimated to be farther off than this, relative to the mean distance from the
  /// middle; 0: none.
  double tolerance = 0;
  int maximumStates = 20000;
  bool testStarShape = true;
};

/// The limit along one ray.
struct BoundaryState {
  double distance = 0;   ///< from the middle, in strain coordinates
  double remaining = 0;  ///< that smaller gaps could add at most, to first order
  double meanGap = 0;    ///< of the contacts that hold [m]
  int contacts = 0;
  int iterations = 0;
  RestKind kind = RestKind::locked;
  base::TerminationType termination = base::TerminationType::cancelled;
  /// A neighbour's way to fold, brought onto this ray, led farther than the straight way from the middle, and back to
  /// the middle as well.
  bool raised = false;
  /// A neighbour's way to fold led farther, but not back to the middle along the ray: the set is not star-shaped there,
  /// and this surface bounds only the part that the middle sees.
  bool seesBeyond = false;
  CellState cell;
};

/// Keeps what has been computed, so that an interrupted computation goes on where it was. May be null everywhere.
class BoundaryMemory {
 public:
  virtual ~BoundaryMemory() = default;
  /// False if there is nothing under this name.
  virtual bool recall(const std::string& name, BoundaryState& state) = 0;
  virtual void keep(const std::string& name, const BoundaryState& state) = 0;
};

/// The limits of in-plane deformation of a cell as a closed surface in the strain coordinates (mean, deviator, shear)
/// of CellState (thesis 4.3.3): the distance along rays from the middle of the set, on the triangles of a sphere. On
/// its ray each state is connected with the middle through states without overlap, so the set contains the star of
/// rays.
struct StrainSpaceBoundary {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< strain
  CellState middleState;
  SphereMesh mesh;
  std::vector<BoundaryState> states;  ///< one a direction

  base::TerminationType termination = base::TerminationType::failed;
  std::string message;
  /// How far edges are estimated to be off the boundary, relative to the mean distance: half of how far the newer of
  /// their ends was off the edge that it cut.
  double largestError = 0, meanError = 0;

  Eigen::Vector3d strainAt(int direction) const {
    return middle + states[direction].distance * mesh.directions[direction];
  }
  double meanDistance() const;
  int count(bool BoundaryState::*flag) const;
  double largestGap() const;  ///< [m]
  /// Whether every edge belongs to two triangles that pass it in opposite directions, and all limits were found.
  bool isClosed() const;
  double volume() const;  ///< in strain coordinates
};

/// Green strain (E_x, E_y, E_xy) of strain coordinates, E = (FᵀF - I)/2.
Eigen::Vector3d greenStrain(const Eigen::Vector3d& strain);

/// Called with what there is so far, from any of the threads but never from two at once; states that are not known yet
/// have the termination `cancelled`. At most 20 times a second, and less often where copying would cost much.
using BoundaryObserver = std::function<void(const StrainSpaceBoundary&)>;

/// Computed in parallel; the same bytes for any number of threads. After cancellation states not reached have the
/// termination `cancelled`.
StrainSpaceBoundary computeBoundary(const CellSolver& solver, const BoundaryOptions& options,
                                    base::ExecutionContext& context, BoundaryMemory* memory = nullptr,
                                    const BoundaryObserver& observe = {});

}  // namespace pliant::interlock
