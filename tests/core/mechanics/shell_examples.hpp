#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <random>

#include "core/geometry/mesh_generators.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/shell.hpp"

namespace pliant::mechanics {

/// The nodes of a mesh at rest, with nothing between them yet.
inline Model modelOf(const geometry::SurfaceMesh& mesh, int dimension) {
  Model model;
  model.dimension = dimension;
  model.restPositions = mesh.points.topRows(dimension).reshaped();
  return model;
}

/// A rectangle from (0, -width/2) to (length, width/2) whose inner points are moved by up to a fifth of a cell.
inline geometry::SurfaceMesh irregularGrid(double length, double width, int lengthCells, int widthCells) {
  geometry::SurfaceMesh mesh = geometry::makeGrid(length, width, lengthCells, widthCells);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> step(-0.2, 0.2);
  std::vector<char> isOnBoundary(static_cast<std::size_t>(mesh.points.cols()), 0);
  for (const auto& [name, nodes] : mesh.groups)
    for (const int node : nodes) isOnBoundary[node] = 1;
  for (Eigen::Index n = 0; n < mesh.points.cols(); ++n) {
    if (isOnBoundary[n]) continue;
    mesh.points(0, n) += step(random) * length / lengthCells;
    mesh.points(1, n) += step(random) * width / widthCells;
  }
  return mesh;
}

/// Newton's method for ∇E(x) = force on the free coordinates, from `x` (whose other coordinates stay), to rounding.
inline void solveStatics(const Model& model, const Vector& force, Vector& x) {
  const ElasticAssembler assembler(std::make_shared<const Model>(model));
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Vector residual = (force - assembler.gradient(x))(model.dofs.freeCoordinates);
    const Eigen::SimplicialLDLT<SparseMatrix> factors(assembler.hessian(x));
    const Vector step = factors.solve(residual);
    x(model.dofs.freeCoordinates) += step;
    if (step.norm() <= 1e-14 * x.norm()) return;
  }
}

}  // namespace pliant::mechanics
