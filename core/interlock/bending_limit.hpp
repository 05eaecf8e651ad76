#pragma once

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/patch_equilibrium.hpp"

namespace pliant::interlock {

/// How a bending test ended.
enum class BendingKind {
  locked,    ///< elements that are neighbours at rest hold the patch: a limit of bending
  folded,    ///< it stands upright (see steepestSlope), or elements that are not neighbours help to hold it: its
             ///< curvature is far from constant, and bending has no limit that could be told
  unsettled  ///< contact did not settle, or it was cancelled
};

struct BendingOptions {
  /// Across the direction: the curvature there is free (with the direction still a principal one or not) or stays 0.
  Lateral lateral = Lateral::principal;
  double increment = 4;       ///< see PatchSolver::bendInSteps
  double perturbation = 0.3;  ///< of elements centred at rest, see LimitOptions
  unsigned seed = 1;
  /// Tries with seeds that follow one another, of which the farthest counts: a patch may bend in ways that lock earlier
  /// and later, as where its elements turn one way or the other.
  int trials = 3;
};

/// The largest curvature of a patch in one direction (thesis 4.3.3, 4.3.4). It holds for this patch: limits of double
/// curvature fall as a patch grows (thesis 4.5).
struct BendingLimit {
  double angle = 0;       ///< of the principal direction [rad]
  double curvature = 0;   ///< along it [1/m]
  double orthogonal = 0;  ///< across it [1/m]
  BendingKind kind = BendingKind::unsettled;
  /// Of the forces that hold the patch, the share of pairs that are not neighbours.
  double remoteShare = 0;
  double steepest = 0;  ///< slope of the paraboloid below the outermost element
  CellEquilibrium equilibrium;
};

/// Which pairs of a patch are neighbours (n x n, of 0 and 1): elements that are linked, or no farther apart at rest
/// than 1.5 times those that are. On lattices of squares and triangles that is the ring of nearest elements, with
/// diagonals.
Eigen::MatrixXi neighboursAtRest(const UnitCell& patch);

/// What `equilibrium`, reached by PatchSolver::bend, says about bending in that direction.
BendingLimit judged(const PatchSolver& solver, double angle, CellEquilibrium equilibrium);

/// The farthest of all trials, each from `start` perturbed. One that folds is farther than any that locks.
CellEquilibrium farthestBend(const PatchSolver& solver, const CellState& start, const StrainDrive& drive,
                             const BendingOptions& options, const base::ExecutionContext* context);

/// Bends up (z rises from the middle: the curvature is positive), or down, from rest.
BendingLimit bendingLimit(const PatchSolver& solver, double angle, bool down, const BendingOptions& options = {},
                          const base::ExecutionContext* context = nullptr);

/// One for each angle and sign, up first, computed in parallel; the same for any number of threads. Those not reached
/// yet, or not before cancellation, have the termination `cancelled`. `observe` sees what there is so far.
struct BendingLimits {
  BendingLimit up, down;
};
std::vector<BendingLimits> bendingLimits(const PatchSolver& solver, const std::vector<double>& angles,
                                         const BendingOptions& options, base::ExecutionContext& context,
                                         const base::GrowingResults<BendingLimits>::Observer& observe = {});

}  // namespace pliant::interlock
