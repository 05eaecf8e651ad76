#pragma once

#include "core/base/stopwatch.hpp"
#include "core/cloth/cloth_simulation.hpp"

namespace pliant::cloth {

/// A step in the making: what it has cost so far, and the state it leads to.
struct ClothSimulation::Attempt {
  Attempt(ClothSimulation& owner, base::ExecutionContext& executionContext);

  /// The candidate of a (half) step that ends a fraction of the step after its start: minimises the incremental
  /// potential from the better of `x` and the terms' target. False if that fails.
  bool advance(StepTerms terms, const Vector& x, double fraction, Vector& candidate);
  /// Moves `x`, a candidate, to what keeps the limits. False if there is nothing that does.
  bool project(Vector& x);

  ClothSimulation& simulation;
  base::ExecutionContext& context;
  StepRecord record;
  ClothState next;
  Vector x, v;  ///< at the start
};

}  // namespace pliant::cloth
