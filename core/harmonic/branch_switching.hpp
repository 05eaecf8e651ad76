#pragma once

#include <memory>
#include <optional>

#include "core/harmonic/response_point.hpp"
#include "core/solvers/continuation_solver.hpp"

namespace pliant::harmonic {

/// A bifurcation at which another curve crosses the one that it was found on.
struct Crossing {
  std::shared_ptr<const HarmonicBalanceProblem> problem;  ///< of the curve that it was found on
  solvers::BranchPoint at;
  PointKind kind = PointKind::branchPoint;  ///< or periodDoubling
  int depth = 0;                            ///< of the other curve: 1 if it branches off the first one
  Stability stability;
  bool visited = false;  ///< the other curve is known already
};

/// How to get onto the other curve: along the disturbance that neither grows nor dies, the kernel of ∂h/∂z. It is
/// perpendicular to the curve that one is on, in the scaled measure of the continuation, and of length 1 there.
struct Departure {
  std::shared_ptr<const HarmonicBalanceProblem> problem;  ///< with twice the drive periods after a period doubling
  Vector z;                                               ///< of the crossing, in that problem
  double omega = 0;
  Vector direction;  ///< unscaled
  double parameterDirection = 0;
};

/// None if ∂h/∂z cannot be factorised at the crossing.
std::optional<Departure> departureFrom(const Crossing& crossing, double stateScale, double parameterScale);

}  // namespace pliant::harmonic
