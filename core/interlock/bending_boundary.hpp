#pragma once

#include "core/interlock/bending_limit.hpp"
#include "core/interlock/strain_space_boundary.hpp"

namespace pliant::interlock {

/// A patch that is bent, for computeBoundary: its limits of bending as a closed surface over (mean, deviator, twist) of
/// the curvature [1/m], see Paraboloid. Directions in which the patch folds have no limit.
class BentPatch final : public BoundarySubject {
 public:
  /// The solver must outlive this.
  BentPatch(const PatchSolver& solver, const BendingOptions& options);

  const CellContact& contact() const override { return solver_.contact(); }
  /// Centred; each limit perturbs it in its trials.
  CellState start(double perturbation, unsigned seed) const override;
  CellEquilibrium solve(const CellState& start, const StrainDrive& drive, bool loosely,
                        const base::ExecutionContext* context) const override;
  CellState relaxed(const CellState& state) const override { return solver_.relaxed(state); }

 private:
  const PatchSolver& solver_;
  const PatchSolver looser_;
  const BendingOptions options_;
};

}  // namespace pliant::interlock
