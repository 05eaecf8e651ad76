#include "core/interlock/bending_limit.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/interlock/paraboloid.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

namespace {

/// Share of the forces above which elements that are not neighbours are said to hold a patch.
constexpr double mostRemote = 1e-3;

}  // namespace

Eigen::MatrixXi neighboursAtRest(const UnitCell& patch) {
  const int count = static_cast<int>(patch.elements.size());
  const auto apart = [&](int a, int b) { return (patch.elements[a].position - patch.elements[b].position).norm(); };
  Eigen::MatrixXi neighbours = Eigen::MatrixXi::Zero(count, count);
  double longest = 0;
  for (const Link& link : patch.links) longest = std::max(longest, apart(link.a, link.b));
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) neighbours(a, b) = apart(a, b) <= 1.5 * longest;
  return neighbours;
}

BendingLimit judged(const PatchSolver& solver, double angle, CellEquilibrium equilibrium) {
  BendingLimit limit;
  limit.angle = angle;
  limit.equilibrium = std::move(equilibrium);
  const CellState& state = limit.equilibrium.state;
  limit.curvature = strainAlong(state.strain, angle);
  limit.orthogonal = strainAlong(state.strain, angle + 0.5 * std::numbers::pi);
  const Paraboloid paraboloid{state.strain};
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    limit.steepest = std::max(limit.steepest, paraboloid.slope(state.positions(0, i), state.positions(1, i)).norm());
  const Eigen::MatrixXi neighbours = neighboursAtRest(solver.patch());
  double all = 0, remote = 0;
  for (const CellContactForce& contact : limit.equilibrium.contacts) {
    all += contact.force;
    if (neighbours(contact.pair.a, contact.pair.b) == 0) remote += contact.force;
  }
  limit.remoteShare = all > 0 ? remote / all : 0;
  if (limit.equilibrium.converged())
    limit.kind = limit.equilibrium.kind == RestKind::locked && limit.remoteShare <= mostRemote ? BendingKind::locked
                                                                                               : BendingKind::folded;
  return limit;
}

CellEquilibrium farthestBend(const PatchSolver& solver, const CellState& start, const StrainDrive& drive,
                             const BendingOptions& options, const base::ExecutionContext* context) {
  CellEquilibrium best;
  double farthest = 0;
  for (int trial = 0; trial < std::max(1, options.trials); ++trial) {
    const unsigned seed = options.seed + static_cast<unsigned>(trial);
    const CellState from = options.perturbation > 0 ? solver.perturbed(start, options.perturbation, seed) : start;
    CellEquilibrium next = solver.bendInSteps(from, drive, options.increment, context);
    const bool folds = next.converged() && judged(solver, 0, next).kind == BendingKind::folded;
    const double reached =
        folds ? std::numeric_limits<double>::infinity() : drive.load.dot(next.state.strain - start.strain);
    const bool ends = folds || next.termination == base::TerminationType::cancelled;
    next.iterations += best.iterations;
    if (trial == 0 || (next.converged() && (reached > farthest || !best.converged()))) {
      best = std::move(next);
      farthest = reached;
    } else {
      best.iterations = next.iterations;
    }
    if (ends) break;
  }
  return best;
}

BendingLimit bendingLimit(const PatchSolver& solver, double angle, bool down, const BendingOptions& options,
                          const base::ExecutionContext* context) {
  const CellState start = solver.relaxed(restState(solver.patch()));
  return judged(
      solver, angle, farthestBend(solver, start, uniaxialDrive(angle, down, options.lateral), options, context));
}

std::vector<BendingLimits> bendingLimits(const PatchSolver& solver, const std::vector<double>& angles,
                                         const BendingOptions& options, base::ExecutionContext& context,
                                         const base::GrowingResults<BendingLimits>::Observer& observe) {
  const int count = 2 * static_cast<int>(angles.size());
  std::vector<BendingLimits> limits(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i)
    for (BendingLimit* limit : {&limits[i].up, &limits[i].down}) {
      limit->angle = angles[i];
      limit->equilibrium.termination = base::TerminationType::cancelled;
    }
  base::GrowingResults<BendingLimits> growing(limits, count, context, observe);
  math::parallelFor(count, [&](int i) {
    if (context.cancelRequested()) return;
    const auto side = i % 2 == 0 ? &BendingLimits::up : &BendingLimits::down;
    BendingLimit limit = bendingLimit(solver, angles[i / 2], i % 2 == 1, options, &context);
    growing.add([&](std::vector<BendingLimits>& all) { all[i / 2].*side = std::move(limit); });
  });
  return limits;
}

}  // namespace pliant::interlock
