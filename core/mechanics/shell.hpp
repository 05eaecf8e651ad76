#pragma once

#include <memory>
#include <span>
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

/// What multiplies the material in each triangle: one number a triangle, or none where all are 1.
struct TriangleFactors {
  std::span<const double> stiffness = {};  ///< of Young's modulus
  std::span<const double> thickness = {};
};

/// Constant-strain triangles with a St. Venant-Kirchhoff material in plane stress, in 2 or 3 dimensions
/// (MembraneElement). Throws base::InputError for a material, factor or triangle that makes no sense.
std::shared_ptr<const Energy> makeMembrane(int dimension, const Vector& restPositions, const Triangles& triangles,
                                           const ShellMaterial& material, const TriangleFactors& factors = {});

/// Discrete shells (Grinspun et al. 2003) in 3 dimensions: one dihedral-angle spring an interior edge,
///   E = Σ ½ D |e|²/(A₁ + A₂) (θ - θ₀)²,  D = Y h³ / (12 (1 - ν²)),
/// with the rest length |e| of the edge, the rest areas of its two triangles, and the rest angle θ₀ (flat or curved).
/// The factor ½ D makes a strip that is rolled up along its edges, and an equilateral mesh that is rolled up in any
/// direction, store D κ²/2 an area (the latter after Seung & Nelson 1988). A dihedral angle knows no Poisson effect of
/// its own, so what a mesh does beyond that is its own, whatever the material's ν: equilateral triangles bend like a
/// plate with ν = -1/3 (a free narrow strip has 8/9 D, where the plate has (1 - ν²) D); a strip of square cells has
/// about 4/5 D, less if cells are shorter than wide, down to D/2; irregular meshes scatter. Where its triangles differ,
/// an edge has the mean D of both, weighted by area. Null if there is no interior edge. Throws base::InputError.
std::shared_ptr<const Energy> makeHingeBending(const Vector& restPositions, const Triangles& triangles,
                                               const ShellMaterial& material, const TriangleFactors& factors = {});

enum class MassMatrix { lumped, consistent };

/// Adds the triangles' mass (density * thickness * area) to `entries`, on all coordinates. Throws base::InputError.
void addShellMass(int dimension, const Vector& restPositions, const Triangles& triangles, const ShellMaterial& material,
                  MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries, const TriangleFactors& factors = {});

}  // namespace pliant::mechanics
