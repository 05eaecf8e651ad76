#include "tests/benchmarks/bench_scaling.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "core/base/stopwatch.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/harmonic/jacobian_solver.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/shell.hpp"

namespace pliant::bench {

namespace {

using base::Json;
using mechanics::Model;

constexpr int repetitions = 5;

/// A square sheet of shell, `cells` a side, one edge of which turns by up to 20 degrees.
std::shared_ptr<const Model> sheet(int cells) {
  const geometry::SurfaceMesh mesh = geometry::makeGrid(0.2, 0.2, cells, cells);
  auto model = std::make_shared<Model>();
  model->restPositions = mesh.points.reshaped();
  const mechanics::ShellMaterial material{1e8, 0.3, 1200, 1e-3};
  model->energies = {mechanics::makeMembrane(3, model->restPositions, mesh.triangles, material),
                     mechanics::makeHingeBending(model->restPositions, mesh.triangles, material)};
  std::vector<Eigen::Triplet<double>> entries;
  mechanics::addShellMass(3, model->restPositions, mesh.triangles, material, mechanics::MassMatrix::lumped, entries);
  auto mass = std::make_shared<mechanics::SparseMatrix>(model->coordinateCount(), model->coordinateCount());
  mass->setFromTriplets(entries.begin(), entries.end());
  model->elementMass = mass;
  model->massDamping = 1;
  model->drives = {mechanics::makeRotation(mesh.groups.at("start"), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY(),
                                           {{{1, 20 * std::numbers::pi / 180, 0}}})};
  model->finish();
  return model;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

Json measure(int cells, int harmonics, int samples) {
  const harmonic::HarmonicBalanceProblem problem(sheet(cells), {harmonics, samples});
  harmonic::JacobianSolver solver(problem);
  // Every iteration of a solve but the first finds the symbolic analysis made.
  const harmonic::Vector z = problem.restCoefficients();
  harmonic::Vector h;
  std::vector<double> seconds, unavoidable;
  for (int i = 0; i <= repetitions; ++i) {
    const double before = problem.cost().seconds();
    const base::Stopwatch watch;
    solver.linearize(z, 5, h, nullptr);
    solver.factorize();
    solver.solve(h);
    if (i == 0) continue;
    seconds.push_back(watch.seconds());
    unavoidable.push_back(problem.cost().seconds() - before);
  }
  const double megabytes =
      8e-6 * (solver.factorization()->factorEntries() + 1.5 * static_cast<double>(solver.jacobian().nonZeros()));
  Json row;
  row["area"] = "harmonic";
  row["name"] = "newton-iteration/n-" + std::to_string(problem.model().dofs.freeCount()) + "/H-" +
                std::to_string(harmonics) + "/N-" + std::to_string(samples);
  row["seconds"] = median(seconds);
  row["iterations"] = 1;
  row["unavoidable_seconds"] = median(unavoidable);
  row["thesis_seconds"] = nullptr;
  row["size"] = problem.size();
  row["megabytes"] = megabytes;
  std::printf("%-36s %7d %10.4f s %10.4f s %6.2f %9.0f MB\n", row["name"].get<std::string>().c_str(),
              static_cast<int>(problem.size()), median(seconds), median(unavoidable),
              median(seconds) / median(unavoidable), megabytes);
  std::fflush(stdout);
  return row;
}

}  // namespace

void measureNewtonIterations(Json& rows) {
  std::printf(
      "\n%-36s %7s %12s %12s %6s %12s\n", "one Newton iteration", "size", "time", "unavoidable", "ratio", "memory");
  for (const int cells : {6, 10, 16}) rows.push_back(measure(cells, 5, 64));
  for (const int harmonics : {3, 8, 12}) rows.push_back(measure(10, harmonics, 64));
  for (const int samples : {32, 128}) rows.push_back(measure(10, 5, samples));
}

}  // namespace pliant::bench
