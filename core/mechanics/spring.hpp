#pragma once

#include <memory>
#include <vector>

#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// Force of a spring as a polynomial of its elongation e: Σ coefficients[i] e^(i+1), coefficients[i] in N/m^(i+1).
struct SpringLaw {
  std::vector<double> coefficients;
};

/// Between two points; e = distance - restLength [m].
std::shared_ptr<const Energy> makeSpring(int dimension, int nodeA, int nodeB, double restLength, const SpringLaw& law);

/// Between a point and a fixed place; e = distance - restLength [m].
std::shared_ptr<const Energy> makeAnchoredSpring(int dimension, int node, const Vector& anchor, double restLength,
                                                 const SpringLaw& law);

/// Grounded along a direction (unit vector); e = direction · (x - rest) [m], positive or negative.
std::shared_ptr<const Energy> makeGroundedSpring(int dimension, int node, const Vector& rest, const Vector& direction,
                                                 const SpringLaw& law);

}  // namespace pliant::mechanics
