#pragma once

#include "core/cloth/strain_limiter.hpp"

namespace pliant::cloth {

/// Triangle after triangle, over and over (after Provot 1995 and Thomaszewski et al. 2009): where a direction of a
/// triangle is stretched beyond a bound, its corners move by the least weighted displacement that brings that direction
/// back to the bound. Stops when no bound is exceeded by more than the tolerance, or after the allowed sweeps. What it
/// converges to keeps the limits, but it is not the nearest point; it has no multipliers and no bound on the distance.
std::unique_ptr<StrainLimiter> makeGaussSeidelLimiter(const solvers::ConeConstraints& constraints,
                                                      const ProjectionOptions& options);

}  // namespace pliant::cloth
