#include "tests/benchmarks/bench_interlock.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/stopwatch.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/limit_grid.hpp"
#include "core/interlock/strain_space_boundary.hpp"
#include "core/math/parallel.hpp"
#include "tests/benchmarks/bench_patches.hpp"

namespace pliant::bench {

namespace {

using base::Json;

/// The thesis gives no times for boundaries.
Json rowOf(const std::string& name, std::size_t size, double seconds, long iterations, double gap, double remaining,
           const std::string& sentence) {
  Json row;
  row["area"] = "interlock";
  row["name"] = name + "/threads-" + std::to_string(math::threadCount());
  row["seconds"] = seconds;
  row["iterations"] = iterations;
  row["unavoidable_seconds"] = nullptr;
  row["thesis_seconds"] = nullptr;
  row["size"] = size;
  row["largest_gap_over_radius"] = gap;
  row["largest_remaining"] = remaining;
  row["outcome"] = sentence;
  std::printf("%-36s %6zu %9.2f s %9ld %10.1e %10.1e  %s\n", row["name"].get<std::string>().c_str(), size, seconds,
              iterations, gap, remaining, sentence.c_str());
  std::fflush(stdout);
  return row;
}

Json measureBoundary(const interlock::UnitCell& cell, int threads) {
  math::setThreadCount(threads);
  base::ExecutionContext context;
  const interlock::CellSolver solver(cell);
  const base::Stopwatch watch;
  const interlock::StrainSpaceBoundary boundary = computeBoundary(solver, {}, context);
  const double seconds = watch.seconds();
  long iterations = 0;
  double remaining = 0;
  for (const interlock::BoundaryState& state : boundary.states) {
    iterations += state.iterations;
    remaining = std::max(remaining, state.remaining);
  }
  return rowOf("boundary/" + cell.name, boundary.states.size(), seconds, iterations,
               boundary.largestGap() / cell.smallestRadius(), remaining,
               boundary.isClosed() ? "closed, " + std::to_string(boundary.computedRays) + " rays" : boundary.message);
}

/// The thesis's 36 x 20 x 2 limits (4.3.3).
Json measureGrid(const interlock::UnitCell& cell) {
  base::ExecutionContext context;
  const interlock::CellSolver solver(cell);
  const base::Stopwatch watch;
  const interlock::LimitGrid grid = computeLimitGrid(solver, {}, context);
  const double seconds = watch.seconds();
  double remaining = 0;
  for (const interlock::GridSlice& slice : grid.slices)
    remaining = std::max({remaining, slice.stretched.equilibrium.remaining, slice.compressed.equilibrium.remaining});
  return rowOf("grid/" + cell.name, 2 * grid.slices.size(), seconds, grid.iterations(),
               grid.largestGap() / cell.smallestRadius(), remaining,
               grid.message.empty() ? std::to_string(grid.missedCount()) + " slices missed" : grid.message);
}

}  // namespace

Json measureInterlock() {
  std::printf("%-36s %6s %11s %9s %10s %10s\n", "boundary", "states", "time", "Newton", "gap / r", "remaining");
  Json rows = Json::array();
  const std::vector<interlock::UnitCell> cells{
      interlock::threefold(), interlock::torusKnot(), interlock::scaleMail(), interlock::fourInOne()};
  for (const int threads : {1, 0})
    for (const interlock::UnitCell& cell : cells) rows.push_back(measureBoundary(cell, threads));
  for (const interlock::UnitCell& cell : cells) rows.push_back(measureGrid(cell));
  for (Json& row : measurePatches()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace pliant::bench
