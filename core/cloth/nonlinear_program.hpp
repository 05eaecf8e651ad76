#pragma once

#include "core/cloth/strain_limiter.hpp"

namespace pliant::cloth {

/// The same problem as a general nonlinear program, by Ipopt with its default options (thesis 3.5.1): directions as
/// |Fv|² <= 1, an ellipse as tr(I - C') >= 0 and det(I - C') >= 0 with C' = T FᵀF T, exact first and second
/// derivatives. The bound on the distance comes from its multipliers.
std::unique_ptr<StrainLimiter> makeNonlinearProgramLimiter(const solvers::ConeConstraints& constraints,
                                                           const ProjectionOptions& options);

}  // namespace pliant::cloth
