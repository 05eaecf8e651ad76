#pragma once

#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/harmonic/design_objective.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/solid.hpp"

namespace pliant::harmonic {

/// A number g(z(p), p) of a design and its motion that constraints hold within bounds: smooth, with its derivatives.
/// What is the largest or the smallest of many is replaced by a smooth bound of it, so that a constraint that holds for
/// the bound holds for the extreme, up to what lies between the instants: (π H / instants)² / 2 of a swing at most.
class ConstraintQuantity : public DesignObjective {
 public:
  /// Without smoothing: the extreme itself, over more instants.
  virtual double exactValue(const HarmonicBalanceProblem& problem, const Vector& z) const = 0;
};

/// The mass of the whole model [kg].
double totalMass(const Model& model);
std::shared_ptr<const ConstraintQuantity> makeTotalMass();

/// Triangles and tetrahedra whose strain counts.
struct StrainGoal {
  mechanics::Triangles triangles;    ///< in their plane; bending does not strain them
  mechanics::Tetrahedra tetrahedra;  ///< in 3 dimensions
  /// β of ln(Σ exp(β strain)) / β over elements and 128 instants or more: it exceeds the largest by ln(number) / β at
  /// most.
  double sharpness = 1e4;
};
/// Largest principal stretch minus 1 of any of these elements at any time.
std::shared_ptr<const ConstraintQuantity> makeLargestStrain(StrainGoal goal);

struct Plane {
  Vector point;   ///< [m]
  Vector normal;  ///< any length; distances count along it
};
struct Sphere {
  Vector centre;
  double radius = 0;  ///< [m]; distances count outwards
};
struct OtherNode {
  int node = 0;
};
/// Nodes that stay away from something.
struct ClearanceGoal {
  std::vector<int> nodes;
  std::variant<Plane, Sphere, OtherNode> from;
  /// β of -ln(Σ exp(-β distance)) / β over nodes and 512 instants or more [1/m]: it is below the smallest distance by
  /// ln(number) / β at most.
  double sharpness = 1e4;
};
/// Smallest distance of any of these nodes from it over a period [m].
std::shared_ptr<const ConstraintQuantity> makeClearance(ClearanceGoal goal);

/// lower <= g <= upper; equal bounds make an equation.
struct DesignConstraint {
  std::string name;
  std::shared_ptr<const ConstraintQuantity> quantity;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double scale = 1;  ///< of g, that counts as 1
};

/// Every kind of quantity, each with a random example for a problem with at least three nodes, so that one test checks
/// the gradients of all of them.
struct ConstraintKind {
  std::string name;
  std::function<std::shared_ptr<const ConstraintQuantity>(const HarmonicBalanceProblem&, std::mt19937&)> example;
};
const std::vector<ConstraintKind>& constraintKinds();

}  // namespace pliant::harmonic
