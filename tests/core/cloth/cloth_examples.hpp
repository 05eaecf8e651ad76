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
  for (const auto& nodes : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = mesh.points.col(nodes[static_cast<std::size_t>(i)]);
    problem.sheet.triangles.push_back({nodes, cloth::shapeGradients(corners, Eigen::Vector3d::UnitX()), -1});
  }
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

/// The problem with one isotropic limit for all triangles.
inline ClothProblem withLimit(ClothProblem problem, double stretch) {
  problem.sheet.limits = {cloth::IsotropicLimit{stretch}};
  problem.sheet.constraints = {cloth::exactConstraints(problem.sheet.limits.front())};
  for (cloth::SheetTriangle& triangle : problem.sheet.triangles) triangle.limit = 0;
  return problem;
}

/// The problem with its two corners at x = 0 locked.
inline ClothProblem hungByCorners(ClothProblem problem) {
  return withModel(std::move(problem), [](mechanics::Model& model) {
    const double side = model.restPositions.maxCoeff();
    for (int node = 0; node < model.nodeCount(); ++node)
      for (int axis = 0; axis < 3; ++axis)
        if (model.restPositions[3 * node] == 0 && std::abs(model.restPositions[3 * node + 1]) > 0.499 * side)
          model.lockedCoordinates[static_cast<std::size_t>(3 * node + axis)] = 1;
  });
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
