#include "core/interlock/limit_grid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "core/math/parallel.hpp"

namespace pliant::interlock {

namespace {

using base::TerminationType;

/// A principal strain is missed if it is farther off than this, relative to the range of strains.
constexpr double missedAbove = 1e-3;

/// All slices of one principal direction.
class DirectionSlices {
 public:
  DirectionSlices(const CellSolver& solver, const CellSolver& looser, double angle, const CellState& start,
                  const base::ExecutionContext& context)
      : solver_(solver), looser_(looser), angle_(angle), start_(start), context_(context) {}

  std::vector<GridSlice> compute(int steps) const {
    const double start = strainAlong(start_.strain, angle_);
    const double low = strainAlong(pulled(solver_, start_, true, infinite).state.strain, angle_);
    const double high = strainAlong(pulled(solver_, start_, false, infinite).state.strain, angle_);
    std::vector<GridSlice> slices(steps);
    int firstAbove = 0;
    for (int k = 0; k < steps; ++k) {
      slices[k].angle = angle_;
      slices[k].wanted = low + (high - low) * (k + 0.5) / steps;
      if (slices[k].wanted < start) firstAbove = k + 1;
    }
    // From the start outwards, each from where the one before was.
    const double tolerance = missedAbove * (high - low);
    CellState state = start_;
    for (int k = firstAbove; k < steps; ++k) fill(slices[k], state, tolerance);
    state = start_;
    for (int k = firstAbove - 1; k >= 0; --k) fill(slices[k], state, tolerance);
    return slices;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Across, the cell stretches as it likes.
  CellEquilibrium pulled(const CellSolver& solver, const CellState& from, bool compress, double farthest) const {
    StrainDrive drive = uniaxialDrive(angle_, compress, Lateral::principal);
    drive.farthest = farthest;
    return solver.solve(from, drive, &context_);
  }

  /// Moves `state` to the wanted principal strain and looks for the limits across.
  void fill(GridSlice& slice, CellState& state, double tolerance) const {
    const double way = slice.wanted - strainAlong(state.strain, angle_);
    if (std::abs(way) > 1e-12) state = looser_.relaxed(pulled(looser_, state, way < 0, std::abs(way)).state);
    slice.principal = strainAlong(state.strain, angle_);
    slice.missed = std::abs(slice.principal - slice.wanted) > tolerance;
    slice.stretched = across(state, false);
    slice.compressed = across(state, true);
  }

  DirectionLimit across(const CellState& state, bool compress) const {
    const double angle = angle_ + 0.5 * std::numbers::pi;
    DirectionLimit limit{angle, 0, solver_.solve(state, uniaxialDrive(angle, compress, Lateral::held), &context_)};
    limit.strain = strainAlong(limit.equilibrium.state.strain, angle);
    return limit;
  }

  const CellSolver &solver_, &looser_;
  const double angle_;
  const CellState& start_;
  const base::ExecutionContext& context_;
};

}  // namespace

int LimitGrid::missedCount() const {
  return static_cast<int>(
      std::count_if(slices.begin(), slices.end(), [](const GridSlice& slice) { return slice.missed; }));
}

double LimitGrid::largestGap() const {
  double largest = 0;
  for (const GridSlice& slice : slices)
    largest = std::max({largest, slice.stretched.equilibrium.meanGap, slice.compressed.equilibrium.meanGap});
  return largest;
}

long LimitGrid::iterations() const {
  long sum = 0;
  for (const GridSlice& slice : slices)
    sum += slice.stretched.equilibrium.iterations + slice.compressed.equilibrium.iterations;
  return sum;
}

LimitGrid computeLimitGrid(const CellSolver& solver, const LimitGridOptions& options, base::ExecutionContext& context) {
  const CellSolver looser(solver.contact().cell(), withLooserGaps(solver.options()));
  // Without any strain, so that all directions are principal ones.
  const CellState start =
      solver.relaxed(solver.perturbed(restState(solver.contact().cell()), options.perturbation, options.seed));
  std::vector<std::vector<GridSlice>> byDirection(options.directions);
  std::atomic<int> done{0};
  math::parallelFor(options.directions, [&](int i) {
    if (context.cancelRequested()) return;
    const double angle = std::numbers::pi * i / options.directions;
    byDirection[i] = DirectionSlices(solver, looser, angle, start, context).compute(options.steps);
    context.reportProgress(static_cast<double>(++done) / options.directions);
  });
  LimitGrid grid;
  int failed = 0, unlimited = 0;
  for (const auto& slices : byDirection)
    for (const GridSlice& slice : slices) {
      for (const DirectionLimit* limit : {&slice.stretched, &slice.compressed}) {
        failed += !limit->equilibrium.converged();
        unlimited += limit->equilibrium.converged() && limit->equilibrium.kind == RestKind::unlimited;
      }
      grid.slices.push_back(slice);
    }
  const std::string all = " of " + std::to_string(2 * options.directions * options.steps) + " limits";
  grid.termination = TerminationType::converged;
  if (context.cancelRequested()) {
    grid.termination = TerminationType::cancelled;
    grid.message = "the grid was cancelled";
  } else if (failed > 0) {
    grid.termination = TerminationType::failed;
    grid.message = "contact did not settle in " + std::to_string(failed) + all;
  } else if (unlimited > 0) {
    grid.termination = TerminationType::infeasible;
    grid.message = "nothing bounds " + std::to_string(unlimited) + all;
  }
  return grid;
}

}  // namespace pliant::interlock
