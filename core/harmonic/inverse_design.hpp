#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/design_objective.hpp"
#include "core/harmonic/periodic_motion.hpp"
#include "core/solvers/bounded_quasi_newton.hpp"

namespace pliant::harmonic {

struct InverseDesignOptions {
  double omega = 0;             ///< [rad/s]
  std::vector<int> parameters;  ///< that may change, by index in `Model::parameters`
  PeriodicMotionOptions motion;
  /// Of variables that are the parameters' places between their bounds, 0 to 1.
  solvers::BoundedQuasiNewtonOptions optimizer{.gradientTolerance = 1e-5, .valueTolerance = 1e-6, .maximumStep = 0.3};
  /// A motion that is farther from where the sensitivity foretold it, relative to its swing, is not trusted to be on
  /// the same branch: the change of the design is halved.
  double largestSurprise = 0.5;
  double smallestShare = 1.0 / 16;  ///< of a change of the design that is tried before it counts as failed
};

/// A design on the way.
struct DesignIterate {
  int iteration = 0;                   ///< 0 for the first design
  std::shared_ptr<const Model> model;  ///< with the design's parameters
  Vector values;                       ///< of the parameters that may change
  Vector z;                            ///< its motion
  std::vector<Amplitude> amplitudes;   ///< a probe each
  double objective = 0;
  double projectedGradient = 0;  ///< of the scaled variables: the largest component that the bounds leave
  double stepLength = 0;         ///< fraction of the quasi-Newton step
  int evaluations = 0;           ///< of the objective so far
  int solves = 0;                ///< motions solved for so far
};

struct InverseDesignResult {
  base::SolverReport report;           ///< of the optimiser; failed with a sentence if the first design has no motion
  std::vector<DesignIterate> history;  ///< every accepted design, each better than the one before; the last is the best
  int evaluations = 0;
  int solves = 0;         ///< motions solved for, those on the way to a design included
  int failedDesigns = 0;  ///< trial designs whose motion was not found
  SolutionCost cost;
};

/// Changes parameters of `problem`'s model within their bounds so that the objective falls (2.4.3).
///
/// The first motion is found as `solvePeriodicMotion` does; from then on the branch of motions is followed: each new
/// design's motion is corrected by Newton's method from what dz/dp foretells (2.4.4), and where that fails, ends
/// elsewhere than foretold, or crosses a fold (the sign of det ∂h/∂z changes), the change of the design is halved. A
/// design that cannot be reached so has no objective, which shortens the optimiser's step.
///
/// `onIterate` is called with every accepted design from the calling thread. On cancellation, the best design so far.
InverseDesignResult designInversely(HarmonicBalanceProblem problem, const DesignObjective& objective,
                                    const InverseDesignOptions& options, base::ExecutionContext& context,
                                    const std::function<void(const DesignIterate&)>& onIterate = {});

}  // namespace pliant::harmonic
