#pragma once

#include <QString>
#include <memory>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::panels {

/// The motion of one design of a study, to be shown: coefficients `z` of `problem`.
struct DesignMotion {
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  harmonic::Vector z;
  QString label;  ///< which design it is, and its objective
};

}  // namespace pliant::panels
