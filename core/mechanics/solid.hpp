#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/mechanics/model.hpp"
#include "core/mechanics/shell.hpp"

namespace pliant::mechanics {

using Tetrahedra = std::vector<std::array<int, 4>>;  ///< global node indices

struct SolidMaterial {
  double youngModulus = 0;  ///< [Pa]
  double poissonRatio = 0;
  double density = 0;  ///< [kg/m³]
};

/// Linear tetrahedra with a St. Venant-Kirchhoff material in 3 dimensions (SolidElement). `stiffnessFactors` multiply
/// Young's modulus, one a tetrahedron; none: all 1. Constant strain makes such elements too stiff in bending: a
/// cantilever's first frequency is 66 to 76 % too high with one cell of five tetrahedra through its thickness, 21 to
/// 25 % with two and 6 to 7 % with four (ν = 0.3 and 0; tests/core/mechanics/test_solid), of second order in the cells.
/// Throws base::InputError for a material, factor or tetrahedron that makes no sense.
std::shared_ptr<const Energy> makeSolid(const Vector& restPositions, const Tetrahedra& tetrahedra,
                                        const SolidMaterial& material, std::span<const double> stiffnessFactors = {});

/// Adds the tetrahedra's mass (density * volume) to `entries`, on all coordinates. Throws base::InputError.
void addSolidMass(const Vector& restPositions, const Tetrahedra& tetrahedra, const SolidMaterial& material,
                  MassMatrix kind, std::vector<Eigen::Triplet<double>>& entries);

}  // namespace pliant::mechanics
