#include "tests/benchmarks/bench_patches.hpp"

#include <cstdio>

#include "core/base/stopwatch.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/patch_equilibrium.hpp"

namespace pliant::bench {

namespace {

using base::Json;

struct PatchCase {
  const char* name;
  interlock::UnitCell cell;
  interlock::PatchOutline outline;
  double thesisSeconds;
};

std::vector<PatchCase> patchCases() {
  const auto disk = [](const interlock::UnitCell& cell, int shells) {
    interlock::PatchOutline outline;
    outline.radius = (shells + 0.01) * cell.lattice.col(0).norm();
    return outline;
  };
  const auto square = [](const interlock::UnitCell& cell, int side) {
    interlock::PatchOutline outline;
    const double spacing = cell.lattice(0, 0);
    outline.kind = interlock::PatchOutline::Kind::rectangle;
    outline.size = Eigen::Vector2d::Constant((side - 0.5) * spacing);
    outline.centre = Eigen::Vector2d::Constant(side % 2 == 0 ? 0.5 * spacing : 0);
    return outline;
  };
  const interlock::UnitCell threefold = interlock::threefold(), knot = interlock::torusKnot(),
                            scale = interlock::scaleMail();
  return {{"threefold/19", threefold, disk(threefold, 2), 133.526},
          {"threefold/37", threefold, disk(threefold, 3), 883.701},
          {"threefold/61", threefold, disk(threefold, 4), 1883.044},
          {"torus knot/16", knot, square(knot, 4), 216.75},
          {"torus knot/25", knot, square(knot, 5), 722.203},
          {"torus knot/36", knot, square(knot, 6), 1647.41},
          {"scale mail/19", scale, disk(scale, 2), 179.057},
          {"scale mail/37", scale, disk(scale, 3), 962.517},
          {"scale mail/61", scale, disk(scale, 4), 4929.636}};
}

/// 0.5 N down on the element nearest the middle, weights with the density of a printing resin; the elements farthest
/// from the middle, corners of the patch, are clamped. The thesis does not say where its patches are held.
Json measurePatch(const PatchCase& patchCase) {
  const interlock::UnitCell patch = interlock::cutPatch(patchCase.cell, patchCase.outline);
  interlock::EquilibriumOptions options;
  options.finalGap = 5e-4;
  options.looseTolerance = 1;
  options.maximumIterations = 5000;
  const base::Stopwatch watch;
  const interlock::PatchSolver solver(patch, options);
  interlock::PatchLoads loads;
  loads.forces = weightsOf(patch, 1180, {0, 0, -9.81});
  int middle = 0;
  double nearest = 1e300, farthest = 0;
  for (const interlock::InterlockingElement& element : patch.elements)
    farthest = std::max(farthest, element.position.norm());
  for (std::size_t i = 0; i < patch.elements.size(); ++i) {
    const double distance = patch.elements[i].position.norm();
    if (distance < nearest - 1e-9) nearest = distance, middle = static_cast<int>(i);
    if (distance > farthest - 1e-9) loads.clamped.push_back(static_cast<int>(i));
  }
  loads.forces.push_back({middle, {0, 0, -0.5}, Eigen::Vector3d::Zero()});
  const interlock::CellEquilibrium rest = solver.solve(interlock::restState(patch), loads);
  const double seconds = watch.seconds(), gap = rest.meanGap / solver.radius();
  Json row;
  row["area"] = "interlock";
  row["name"] = std::string("patch/") + patchCase.name;
  row["seconds"] = seconds;
  row["iterations"] = rest.iterations;
  row["unavoidable_seconds"] = nullptr;
  row["thesis_seconds"] = patchCase.thesisSeconds;
  row["size"] = patch.elements.size();
  row["mean_gap_over_radius"] = gap;
  row["converged"] = rest.converged();
  row["deflection"] = rest.state.positions(2, middle);
  std::printf("%-24s %4zu %9.2f s %10.1f s %8.0f x %7d %10.1e %9.2f mm  %s\n", row["name"].get<std::string>().c_str(),
              patch.elements.size(), seconds, patchCase.thesisSeconds, patchCase.thesisSeconds / seconds,
              rest.iterations, gap, 1e3 * rest.state.positions(2, middle),
              rest.converged() ? "" : rest.message.c_str());
  std::fflush(stdout);
  return row;
}

}  // namespace

Json measurePatches() {
  std::printf("%-24s %4s %11s %12s %10s %7s %10s %12s\n", "patch (Table 4.1)", "", "time", "thesis", "ratio", "Newton",
              "gap / r", "deflection");
  Json rows = Json::array();
  for (const PatchCase& patchCase : patchCases()) rows.push_back(measurePatch(patchCase));
  return rows;
}

}  // namespace pliant::bench
