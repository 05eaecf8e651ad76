#pragma once

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/mechanics/elastic_assembler.hpp"

namespace pliant::solvers {

struct StaticEquilibriumOptions {
  double tolerance = 1e-9;      ///< on the force that is left over, relative to the force applied
  double stepTolerance = 1e-12; ///< a shorter Newton step, relative to the size of the model, also counts as converged
  int maximumIterations = 40;
  int maximumRampSteps = 64;    ///< levels by which the load may be ramped up where Newton's method alone fails
};

struct StaticEquilibrium {
  mechanics::Vector positions;  ///< of all coordinates [m]
  base::SolverReport report;
};

/// ∇E(x) = `force` on the free coordinates, the others fixed where `start` has them: Newton's method from `start`, and
/// where that fails, continuation from the load that holds `start` in equilibrium to `force`. Both vectors are over all
/// coordinates. Fails with a sentence that names a node and an axis if nothing holds it there: the stiffness is then
/// singular, and a position or motion about it undetermined.
StaticEquilibrium solveStaticEquilibrium(const mechanics::Model& model, const mechanics::ElasticAssembler& assembler,
                                         const mechanics::Vector& start, const mechanics::Vector& force,
                                         const StaticEquilibriumOptions& options, base::ExecutionContext& context);

/// Empty if the stiffness at `positions` is regular, else the sentence that names what nothing holds.
std::string describeMissingStiffness(const mechanics::Model& model, const mechanics::ElasticAssembler& assembler,
                                     const mechanics::Vector& positions);

}  // namespace pliant::solvers
