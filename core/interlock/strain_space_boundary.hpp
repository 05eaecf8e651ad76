#pragma once

#include <functional>
#include <map>
#include <mutex>

#include "core/base/shard.hpp"
#include "core/interlock/cell_symmetry.hpp"
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
  /// Computes one ray of those that symmetries of the cell make the same, if checks of some of the others agree. If
  /// not, since they fold in different ways, all are computed, and symmetric ones get the farthest of theirs.
  bool useSymmetries = true;
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
  /// the middle as well; or that of a symmetric direction did.
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

/// What is deformed: a cell, or a patch that is bent. Every function may be called from any thread.
class BoundarySubject {
 public:
  virtual ~BoundarySubject() = default;
  virtual const CellContact& contact() const = 0;
  /// At rest, but for a perturbation as in LimitOptions.
  virtual CellState start(double perturbation, unsigned seed) const = 0;
  /// As CellSolver::solve; a limit that is none has the kind RestKind::unlimited. `loosely`: with larger gaps.
  virtual CellEquilibrium solve(const CellState& start, const StrainDrive& drive, bool loosely,
                                const base::ExecutionContext* context) const = 0;
  virtual CellState relaxed(const CellState& state) const = 0;
  /// Of its limits; none if they are not known.
  virtual std::vector<CellSymmetry> symmetries() const { return {}; }
};

/// A cell under stretch.
class StretchedCell final : public BoundarySubject {
 public:
  /// The solver must outlive this.
  explicit StretchedCell(const CellSolver& solver);

  const CellContact& contact() const override { return solver_.contact(); }
  CellState start(double perturbation, unsigned seed) const override;
  CellEquilibrium solve(const CellState& start, const StrainDrive& drive, bool loosely,
                        const base::ExecutionContext* context) const override;
  CellState relaxed(const CellState& state) const override { return solver_.relaxed(state); }
  std::vector<CellSymmetry> symmetries() const override { return symmetriesOf(contact().cell()); }

 private:
  const CellSolver& solver_;
  const CellSolver looser_;
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
  int symmetries = 1;             ///< that strains can tell apart
  int computedRays = 0;           ///< of which symmetries make all others
  int checkedRays = 0;            ///< of the others, computed all the same
  double symmetryDifference = 0;  ///< the largest that was found there, relative to the distance

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

/// The same of anything else.
StrainSpaceBoundary computeBoundary(const BoundarySubject& subject, const BoundaryOptions& options,
                                    base::ExecutionContext& context, BoundaryMemory* memory = nullptr,
                                    const BoundaryObserver& observe = {});

/// Only the limits along the rays of one shard, for `memory`; what is left to do takes all of them: computeBoundary
/// with what all shards have kept.
base::TerminationType computeRays(const BoundarySubject& subject, const BoundaryOptions& options,
                                  const base::Shard& shard, base::ExecutionContext& context, BoundaryMemory& memory);
/// The numbers of rays that `memory` does not know and symmetries do not make.
std::vector<int> missingRays(const BoundarySubject& subject, const BoundaryOptions& options, BoundaryMemory& memory);

}  // namespace pliant::interlock
