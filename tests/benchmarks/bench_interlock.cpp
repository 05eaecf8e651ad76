#include "tests/benchmarks/bench_interlock.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/stopwatch.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/strain_space_boundary.hpp"
#include "core/math/parallel.hpp"
#include "tests/benchmarks/bench_patches.hpp"

namespace pliant::bench {

namespace {

using base::Json;

/// The thesis gives no time for a boundary: its 36 x 20 x 2 limits are not timed there.
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
  const double gap = boundary.largestGap() / cell.smallestRadius();
  Json row;
  row["area"] = "interlock";
  row["name"] = "boundary/" + cell.name + "/threads-" + std::to_string(math::threadCount());
  row["seconds"] = seconds;
  row["iterations"] = iterations;
  row["unavoidable_seconds"] = nullptr;
  row["thesis_seconds"] = nullptr;
  row["size"] = boundary.states.size();
  row["largest_gap_over_radius"] = gap;
  row["largest_remaining"] = remaining;
  row["closed"] = boundary.isClosed();
  std::printf("%-36s %6zu %9.2f s %9ld %10.1e %10.1e  %s\n", row["name"].get<std::string>().c_str(),
              boundary.states.size(), seconds, iterations, gap, remaining,
              boundary.isClosed() ? "closed" : boundary.message.c_str());
  std::fflush(stdout);
  return row;
}

}  // namespace

Json measureInterlock() {
  std::printf("%-36s %6s %11s %9s %10s %10s\n", "boundary", "states", "time", "Newton", "gap / r", "remaining");
  Json rows = Json::array();
  for (const int threads : {1, 0})
    for (const interlock::UnitCell& cell :
         {interlock::threefold(), interlock::torusKnot(), interlock::scaleMail(), interlock::fourInOne()})
      rows.push_back(measureBoundary(cell, threads));
  for (Json& row : measurePatches()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace pliant::bench
