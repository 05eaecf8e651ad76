#pragma once

#include <numbers>
#include <random>

#include "core/geometry/mesh_generators.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"
#include "core/mechanics/point_mass_parameter.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/spring.hpp"

namespace pliant::test {

using mechanics::Matrix;
using mechanics::Model;
using mechanics::SparseMatrix;
using mechanics::Vector;

inline Vector vector2(double x, double y) { return Eigen::Vector2d(x, y); }
inline Vector vector3(double x, double y, double z) { return Eigen::Vector3d(x, y, z); }

/// amplitude sin τ.
inline mechanics::PeriodicSignal sine(double amplitude) { return {{{1, amplitude, -0.5 * std::numbers::pi}}}; }
inline mechanics::PeriodicSignal cosine(double amplitude) { return {{{1, amplitude, 0}}}; }

inline void addPointMass(Model& model, const std::string& name, std::vector<int> nodes, double mass) {
  model.pointMasses.push_back({name, std::move(nodes), mass, 0, 10 * mass});
  model.parameters.push_back(mechanics::makePointMassParameter(static_cast<int>(model.pointMasses.size()) - 1, name));
}

/// x'' + 2 ζ x' + x + γ x³ = P cos τ, along x of one node.
inline std::shared_ptr<const Model> duffing(double zeta, double gamma, double force) {
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = vector2(0, 0);
  model->gravity = vector2(0, 0);
  model->lockedCoordinates = {0, 1};
  model->energies = {mechanics::makeGroundedSpring(2, 0, vector2(0, 0), vector2(1, 0), {{1, 0, gamma}})};
  addPointMass(*model, "mass", {0}, 1);
  model->massDamping = 2 * zeta;
  model->forces = {{"force", {0}, vector2(1, 0), cosine(force)}};
  model->probes = {{"mass", 0}};
  model->finish();
  return model;
}

/// A strip of shell along x: 0.1 m by 0.02 m of a soft foil, whose start is clamped and driven.
struct StripOptions {
  int lengthCells = 6;
  int widthCells = 1;
  double youngModulus = 1e8;
  double thickness = 5e-4;
  mechanics::MassMatrix mass = mechanics::MassMatrix::lumped;
  double bump = 0;  ///< random displacement of the rest shape [m]
  bool bending = true;
};
inline geometry::SurfaceMesh stripMesh(const StripOptions& options) {
  geometry::SurfaceMesh mesh = geometry::makeStrip(0.1, 0.02, options.lengthCells, options.widthCells);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> bump(-options.bump, options.bump);
  for (Eigen::Index i = 0; i < mesh.points.size(); ++i) mesh.points.data()[i] += bump(random);
  return mesh;
}
/// The strip without drives: the caller adds them and calls finish().
inline std::shared_ptr<Model> strip(const StripOptions& options, const geometry::SurfaceMesh& mesh) {
  auto model = std::make_shared<Model>();
  model->dimension = 3;
  model->restPositions = mesh.points.reshaped();
  model->gravity = vector3(0, 0, 0);
  model->lockedCoordinates.assign(model->restPositions.size(), 0);
  const mechanics::ShellMaterial material{options.youngModulus, 0.3, 1200, options.thickness};
  model->energies = {mechanics::makeMembrane(3, model->restPositions, mesh.triangles, material)};
  if (options.bending)
    model->energies.push_back(mechanics::makeHingeBending(model->restPositions, mesh.triangles, material));
  std::vector<Eigen::Triplet<double>> entries;
  mechanics::addShellMass(3, model->restPositions, mesh.triangles, material, options.mass, entries);
  auto mass = std::make_shared<SparseMatrix>(model->coordinateCount(), model->coordinateCount());
  mass->setFromTriplets(entries.begin(), entries.end());
  model->elementMass = mass;
  return model;
}

/// The nodes of the first one and a half columns of cells' ends: the start and its neighbours, a clamped edge.
inline std::vector<int> clampedNodes(const geometry::SurfaceMesh& mesh, double upTo) {
  std::vector<int> nodes;
  for (int node = 0; node < mesh.points.cols(); ++node)
    if (mesh.points(0, node) <= upTo) nodes.push_back(node);
  return nodes;
}

/// A random vector of fixed seed with entries in [-1, 1].
inline Vector randomVector(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  return Vector::NullaryExpr(size, [&] { return entry(random); });
}

}  // namespace pliant::test
