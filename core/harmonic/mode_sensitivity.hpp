#pragma once

#include <vector>

#include "core/harmonic/linear_modes.hpp"

namespace pliant::harmonic {

/// dω/dp of natural frequencies about the static equilibrium x(p), which moves with p as well:
///   dω²/dp = φᵀ (∂K/∂p + ∇³E dx/dp - ω² ∂M/∂p) φ,   K dx/dp = -∂(∇E - f)/∂p,
/// of modes that share their frequency with no other (Fox & Kapoor 1968, with the equilibrium's shift by its adjoint:
/// one solve a mode). Derivatives along φ are differences of order 4, exact for elastic forces that are cubic in the
/// positions. `chosen` are indices in `modes.modes`, `parameters` in `Model::parameters`; a row a mode, a column a
/// parameter.
Matrix naturalFrequencyDerivatives(const HarmonicBalanceProblem& problem, const LinearModes& modes,
                                   const std::vector<int>& chosen, const std::vector<int>& parameters);

}  // namespace pliant::harmonic
