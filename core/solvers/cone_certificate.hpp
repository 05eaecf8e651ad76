#pragma once

#include "core/solvers/cone_program.hpp"

namespace pliant::solvers {

/// What multipliers prove about positions x that should be the projection of `candidate`, computed directly from the
/// definitions: for any multipliers that are positive semidefinite,
///   D = Σ ⟨F T Λ, F(x̂) T⟩ - ½ ‖Bᵀ(F T Λ)‖²_{M⁻¹} - Σ ‖F T Λ‖_*
/// is at most the optimum (‖·‖_*: nuclear norm). Fills objective, bound, violation, dualResidual, complementarity and
/// the elements' multipliers of `solution` from its positions and the multipliers of its bounds.
void certify(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate, ConeSolution& solution);

/// Σ (F Λ) w of every node, with the multipliers of the elements (3 x nodes).
Eigen::Matrix3Xd limitForces(const ConeConstraints& constraints, const ConeSolution& solution);

/// The largest bound D [kg m²] that multiples of the solution's multipliers prove. Unlimited values are proof that
/// nothing keeps the bounds (Farkas).
double provenDistance(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate,
                      const ConeSolution& solution);

}  // namespace pliant::solvers
