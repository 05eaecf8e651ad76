#pragma once

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// The largest relative violation of any rigid link or joint (mechanics::constraintViolation) at each of the N samples
/// of a period (thesis Fig. 2.14). Empty if the model has none.
Vector constraintViolations(const HarmonicBalanceProblem& problem, const Vector& z);

}  // namespace pliant::harmonic
