#include "core/interlock/bending_boundary.hpp"

namespace pliant::interlock {

BentPatch::BentPatch(const PatchSolver& solver, const BendingOptions& options)
    : solver_(solver), looser_(solver.patch(), withLooserGaps(solver.options())), options_(options) {}

CellState BentPatch::start(double /*perturbation*/, unsigned /*seed*/) const {
  return solver_.relaxed(restState(solver_.patch()));
}

CellEquilibrium BentPatch::solve(const CellState& start, const StrainDrive& drive, bool loosely,
                                 const base::ExecutionContext* context) const {
  const PatchSolver& solver = loosely ? looser_ : solver_;
  BendingLimit limit = judged(solver, 0, farthestBend(solver, start, drive, options_, context));
  if (limit.equilibrium.kind == RestKind::locked && limit.kind == BendingKind::folded)
    limit.equilibrium.kind = RestKind::unlimited;
  return limit.equilibrium;
}

}  // namespace pliant::interlock
