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

/// In what follows the corners of `triangles` rest at those `restPositions`, unless `restTriangles` are given: then
/// corner i of triangle t rests at restPositions of restTriangles[t][i], and a node may rest in several places, as on
/// the seams of a garment, which its flat pattern is cut along.

/// Constant-strain triangles with a St. Venant-Kirchhoff material in plane stress, in 2 or 3 dimensions
/// (MembraneElement). Throws base::InputError for a material, factor or triangle that makes no sense.
std::shared_ptr<const Energy> makeMembrane(int dimension, const Vector& restPositions, const Triangles& triangles,
                                           const ShellMaterial& material, const TriangleFactors& factors = {},
                                           const Triangles& restTriangles = {});

/// Discrete shells (Grinspun et al. 2003) in 3 dimensions: one dihedral-angle spring an interior edge,
///   E = Σ ½ D |e|²/(A₁ + A₂) (θ - θ₀)²,  D = Y h³ / (12 (1 - ν²)),
/// with the rest length |e| of the edge, the rest areas of its two triangles, and the rest angle θ₀ (flat or curved).
/// The factor ½ D makes a strip that is rolled up along its edges, and an equilateral mesh that is rolled up in any
/// direction, store D κ²/2 an area (the latter after Seung & Nelson 1988). A dihedral angle knows no Poisson effect of
/// its own, so what a mesh does beyond that is its own, whatever the material's ν: equilateral triangles bend like a
/// plate with ν = -1/3 (a free narrow strip has 8/9 D, where the plate has (1 - ν²) D); a strip of square cells has
/// about 4/5 D, less if cells are shorter than wide, down to D/2; irregular meshes scatter. Where its triangles differ,
/// an edge has the mean D of both, weighted by area. A seam, an edge that rests in two places, is ironed flat: θ₀ = 0,
/// whatever lies between these places, and |e| is the mean of both lengths. Null if there is no interior edge. Throws
/// base::InputError.
std::shared_ptr<const Energy> makeHingeBending(const Vector& restPositions, const Triangles& triangles,
                                               const ShellMaterial& material, const TriangleFactors& factors = {},
                                               const Triangles& restTriangles = {});

/// A shell of one material that may be sewn to others.
struct ShellPanel {
  Triangles triangles;
  Vector restPositions;
  Triangles restTriangles;  ///< as above
  ShellMaterial material;
  std::vector<double> stiffnessFactors, thicknessFactors;  ///< as in TriangleFactors
};

/// The bending of makeHingeBending over the edges on which two panels meet, all of them seams. Panels of the same
/// triangles count as one that is as stiff as all. Null if there is no such edge. Throws base::InputError.
std::shared_ptr<const Energy> makeSeamBending(const std::vector<ShellPanel>& panels);

enum class MassMatrix { lumped, consistent };

/// Adds the triangles' mass (density * thickness * area) to `entries`, on all coordinates. Throws base::InputError.
void addShellMass(int dimension, const Vector& restPositions, const Triangles& triangles, const ShellMaterial& material,
                  MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries, const TriangleFactors& factors = {},
                  const Triangles& restTriangles = {});

}  // namespace pliant::mechanics
