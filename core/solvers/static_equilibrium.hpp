#pragma once

#include <string>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/mechanics/elastic_assembler.hpp"

namespace pliant::solvers {

struct StaticEquilibriumOptions {
  double tolerance = 1e-9;       ///< on the force that is left over, relative to the force applied
  double stepTolerance = 1e-12;  ///< a shorter Newton step, relative to the size of the model, also counts as converged
  int maximumIterations = 500;
};

struct StaticEquilibrium {
  mechanics::Vector positions;  ///< of all coordinates [m]
  base::SolverReport report;    ///< residual: the force left over, relative to the force applied
};

/// ∇E(x) = `force` on the free coordinates, the others fixed where `start` has them. Both vectors are over all
/// coordinates. The potential energy E(x) - force·x is minimised from `start` by Newton's method with a diagonal shift
/// (Levenberg 1944) that grows where a step does not lower it and vanishes in the end, so that slack or buckled starts,
/// whose stiffness is singular or indefinite, lead to a stable equilibrium all the same.
/// Fails with a sentence that names a node and an axis if nothing holds it in the equilibrium: the stiffness is then
/// singular, and a position or motion about it undetermined.
StaticEquilibrium solveStaticEquilibrium(const mechanics::Model& model, const mechanics::ElasticAssembler& assembler,
                                         const mechanics::Vector& start, const mechanics::Vector& force,
                                         const StaticEquilibriumOptions& options, base::ExecutionContext& context);

/// Empty if the stiffness at `positions` is regular, else the sentence that names what nothing holds.
std::string describeMissingStiffness(const mechanics::Model& model, const mechanics::ElasticAssembler& assembler,
                                     const mechanics::Vector& positions);

}  // namespace pliant::solvers
