#pragma once

#include "core/cloth/cloth_simulation.hpp"

namespace pliant::bench {

/// A way to project whose time is taken, on the very problems that a simulation meets.
struct Contender {
  std::string name;
  std::string method = "cone";
  bool warmStart = true;
  int directions = 0;  ///< sampled directions in place of the exact limit, 0: exact
  int every = 1;       ///< of so many projections it gets one
  int most = 1000;     ///< projections in all
  double budget = 60;  ///< after which a projection is broken off [s]
};

struct ContestResult {
  int projections = 0;
  int converged = 0;
  double seconds = 0;     ///< mean of a projection
  double iterations = 0;  ///< mean
  double overshoot = 0;   ///< largest stretch of any direction over the limit - 1 that it let through
};

/// Steps the cloth by its scheme with the first contender's projections, and lets the others have a try at the problems
/// it meets after the first `skipped` ones. All use an isotropic limit.
std::vector<ContestResult> runContest(const cloth::ClothProblem& problem, const cloth::SteppingOptions& options,
                                      int steps, int skipped, const std::vector<Contender>& contenders);

/// Seconds that an iteration of the projection cannot do without: one pass over the elements that assembles the linear
/// system, one factorisation and one solution.
double unavoidableSeconds(const cloth::ClothProblem& problem);

}  // namespace pliant::bench
