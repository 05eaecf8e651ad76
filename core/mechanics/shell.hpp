#pragma once

#include <memory>
#include <vector>

#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

using Triangles = std::vector<std::array<int, 3>>;  ///< global node indices

struct ShellMaterial {
  double youngModulus = 0;  ///< [Pa]
  double poissonRatio = 0;
  double density = 0;    ///< [kg/m³]
  double thickness = 0;  ///< [m]
};

/// Constant-strain triangles with a St. Venant-Kirchhoff material in plane stress, in 2 or 3 dimensions.
std::shared_ptr<const Energy> makeMembrane(int dimension, const Vector& restPositions, const Triangles& triangles,
                                           const ShellMaterial& material);

/// Discrete shells (Grinspun et al. 2003): one dihedral-angle spring an interior edge, 3 dimensions; the stiffness follows
/// from the plate's bending modulus. Null if there is no interior edge.
std::shared_ptr<const Energy> makeHingeBending(const Vector& restPositions, const Triangles& triangles,
                                               const ShellMaterial& material);

enum class MassMatrix { lumped, consistent };

/// Adds the triangles' mass (density * thickness * area) to `entries`, on all coordinates.
void addShellMass(int dimension, const Vector& restPositions, const Triangles& triangles, const ShellMaterial& material,
                  MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries);

}  // namespace pliant::mechanics
