#pragma once

#include <random>

#include "core/cloth/cloth_simulation.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/mechanics/shell.hpp"

namespace pliant::test {

using cloth::ClothProblem;

/// Thesis 3.5.
inline constexpr mechanics::ShellMaterial fabric{1800, 0.41, 200, 0.5e-3};

/// A grid of fabric in the plane z = 0, without pins and gravity, as a problem that may still be changed. It has no
/// limits, but its triangles are in the sheet.
inline ClothProblem sheetProblem(int cells, double side = 0.5, mechanics::ShellMaterial material = fabric) {
  const geometry::SurfaceMesh mesh = geometry::makeGrid(side, side, cells, cells);
  auto model = std::make_shared<mechanics::Model>();
  model->restPositions = mesh.points.reshaped();
  model->energies = {mechanics::makeMembrane(3, model->restPositions, mesh.triangles, material),
                     mechanics::makeHingeBending(model->restPositions, mesh.triangles, material)};
  std::vector<Eigen::Triplet<double>> entries;
  mechanics::addShellMass(3, model->restPositions, mesh.triangles, material, mechanics::MassMatrix::lumped, entries);
  mechanics::SparseMatrix mass(model->coordinateCount(), model->coordinateCount());
  mass.setFromTriplets(entries.begin(), entries.end());
  model->elementMass = std::make_shared<const mechanics::SparseMatrix>(mass);
  model->finish();
  ClothProblem problem;
  problem.sheet.nodeCount = model->nodeCount();
  const Eigen::Vector2d none = Eigen::Vector2d::Zero();
  for (const auto& nodes : mesh.triangles) problem.sheet.triangles.push_back({nodes, {none, none, none}, -1});
  problem.sheet.masses = cloth::lumpedMasses(*model);
  problem.sheet.fixed.assign(static_cast<std::size_t>(model->nodeCount()), 0);
  problem.model = std::move(model);
  return problem;
}

/// The problem with a changed model.
template <class Change>
ClothProblem withModel(ClothProblem problem, const Change& change) {
  auto model = std::make_shared<mechanics::Model>(*problem.model);
  change(*model);
  model->finish();
  problem.model = std::move(model);
  return problem;
}

inline ClothProblem withGravity(ClothProblem problem, const Eigen::Vector3d& acceleration) {
  return withModel(std::move(problem), [&](mechanics::Model& model) { model.gravity = acceleration; });
}

/// Numbers that are the same in every run.
inline Eigen::Matrix3Xd scattered(Eigen::Index columns, double size, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-size, size);
  Eigen::Matrix3Xd result(3, columns);
  for (Eigen::Index i = 0; i < result.size(); ++i) result.data()[i] = number(random);
  return result;
}

inline cloth::ClothSimulation simulate(const ClothProblem& problem, cloth::SteppingScheme scheme, double timeStep) {
  cloth::SteppingOptions options;
  options.scheme = scheme;
  options.timeStep = timeStep;
  options.limitMethod = "none";
  options.newton.tolerance = 1e-11;
  return cloth::ClothSimulation(std::make_shared<const ClothProblem>(problem), options);
}

}  // namespace pliant::test
