#pragma once

#include "core/harmonic/design_constraint.hpp"
#include "core/mechanics/element_stress.hpp"

namespace pliant::harmonic {

/// Elements whose stress counts, or the strain of their surfaces: see mechanics::ElementStress.
struct StressGoal {
  mechanics::Triangles triangles;    ///< of membranes and shells, with the bending of the latter
  mechanics::Tetrahedra tetrahedra;  ///< of solids
  mechanics::ElementMeasure measure = mechanics::ElementMeasure::vonMises;
  /// β of ln(Σ exp(β stress)) / β over elements, their surfaces and 128 instants or more [1/Pa], of strain [1]: it
  /// exceeds the largest by ln(number) / β at most.
  double sharpness = 1e-4;
};

/// Largest von Mises stress [Pa], or principal strain, of any of these elements at any time. Throws base::InputError
/// where it is evaluated if the model has no energies of such elements.
std::shared_ptr<const ConstraintQuantity> makeLargestStress(StressGoal goal);

}  // namespace pliant::harmonic
