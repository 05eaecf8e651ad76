#pragma once

#include <memory>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::render {

/// A motion that is predicted for a changed model: coefficients `z` of the free coordinates for the solved `problem`,
/// while driven and locked coordinates are where `model` has them, if given (with the same coordinates as the
/// problem's, and the same of them free).
struct PredictedMotion {
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  mechanics::Vector z;
  std::shared_ptr<const mechanics::Model> model;

  /// All coordinates at any τ [m].
  mechanics::Vector configurationAt(double tau) const;
  /// The same at the problem's N samples: N x coordinates [m].
  mechanics::Matrix trajectories() const;
};

}  // namespace pliant::render
