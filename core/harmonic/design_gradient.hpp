#pragma once

#include <vector>

#include "core/harmonic/design_objective.hpp"
#include "core/harmonic/parameter_jacobian.hpp"
#include "core/harmonic/periodic_motion.hpp"

namespace pliant::harmonic {

/// An objective at a design, and its total derivative by some parameters.
struct DesignGradient {
  double value = 0;
  Vector gradient;      ///< df/dp, one entry for each of the parameters asked for
  bool regular = true;  ///< false if the motion stands at a fold, where it has no derivative; the gradient is 0 then
};

/// ∂f/∂p with the free coordinates held: of the objective itself, and through the coordinates that are not free and
/// move with p. `at` is the objective's value at a motion; one entry for each of `parameters`.
Vector directDerivative(const HarmonicBalanceProblem& problem, const ObjectiveValue& at,
                        const std::vector<int>& parameters);

/// df/dp = ∂f/∂p - (∂h/∂p)ᵀ λ with (∂h/∂z)ᵀ λ = ∂f/∂z (2.4.5): one linear solve, however many parameters, with the
/// factors that `motion` carries, refined against the exact ∂h/∂z; factorises once where there are none or they are too
/// far off. `parameters` are indices in `Model::parameters`.
DesignGradient designGradient(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                              const DesignObjective& objective, const std::vector<int>& parameters);
/// The same with ∂h/∂p of these parameters at this motion.
DesignGradient designGradient(const HarmonicBalanceProblem& problem, const PeriodicMotion& motion,
                              const DesignObjective& objective, const std::vector<int>& parameters,
                              const ParameterJacobian& jacobian);

}  // namespace pliant::harmonic
