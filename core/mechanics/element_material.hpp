#pragma once

namespace pliant::mechanics {

/// What stresses need to know of an element, and its energy does not.
struct ElementMaterial {
  double volume = 0;             ///< at rest [m³]
  double lambda = 0, twoMu = 0;  ///< S = λ tr ε I + 2μ ε, in plane stress for a triangle [Pa]
};

}  // namespace pliant::mechanics
