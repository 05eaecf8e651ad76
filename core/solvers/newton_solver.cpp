#include "core/solvers/newton_solver.hpp"

#include <cmath>

#include "core/base/stopwatch.hpp"

namespace pliant::solvers {

using base::TerminationType;

namespace {

constexpr double sufficientDecrease = 1e-4;

/// A point along a Newton step.
struct Trial {
  Eigen::VectorXd x;
  double norm = 0;             ///< ‖r‖
  Eigen::VectorXd correction;  ///< what the Jacobian at the start of the step makes of r; empty if r is not finite
  bool accepted = false;
};

Trial tryStep(NonlinearSystem& system, const Eigen::VectorXd& x, double norm, const Eigen::VectorXd& step,
              double length) {
  Trial trial;
  trial.x = x + length * step;
  const Eigen::VectorXd residual = system.residual(trial.x);
  trial.norm = residual.norm();
  if (!std::isfinite(trial.norm)) return trial;
  trial.correction = -system.solve(residual);
  trial.accepted = trial.norm <= (1 - sufficientDecrease * length) * norm ||
                   trial.correction.norm() <= (1 - 0.25 * length) * step.norm();
  return trial;
}

}  // namespace

base::SolverReport solveNewton(NonlinearSystem& system, Eigen::VectorXd& x, const NewtonOptions& options,
                               base::ExecutionContext& context) {
  const base::Stopwatch watch;
  base::SolverReport report;
  const auto finish = [&](TerminationType termination, const char* message = "") {
    report.termination = termination;
    report.message = message;
    report.seconds = watch.seconds();
    return report;
  };

  Eigen::VectorXd residual = system.residual(x);
  double norm = residual.norm();
  report.iterations.push_back({0, norm / options.residualScale, 0, 0});
  if (!std::isfinite(norm)) return finish(TerminationType::failed, "The residual is not finite at the starting point.");

  for (int iteration = 1;; ++iteration) {
    if (norm <= options.tolerance * options.residualScale) return finish(TerminationType::converged);
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "Newton's method was cancelled.");
    if (iteration > options.maximumIterations)
      return finish(TerminationType::iterationLimit, "Newton's method reached its iteration limit.");
    if (!system.linearize(x, residual)) return finish(TerminationType::failed, "The Jacobian is singular.");
    const Eigen::VectorXd step = -system.solve(residual);
    const double stepNorm = step.norm();
    if (!std::isfinite(stepNorm)) return finish(TerminationType::failed, "The Jacobian is singular.");
    report.iterations.back().correction = stepNorm / options.stepScale;

    double length = 1;
    Trial trial = tryStep(system, x, norm, step, length);
    if (!trial.accepted && stepNorm <= options.roundingTolerance * options.stepScale)
      return finish(TerminationType::converged);
    while (!trial.accepted) {
      length *= 0.5;
      if (length < options.shortestStep)
        return finish(TerminationType::failed, "The line search found no step that brings the iteration closer.");
      trial = tryStep(system, x, norm, step, length);
    }
    x = trial.x;
    norm = trial.norm;
    const double remaining = trial.correction.norm();
    report.iterations.push_back({iteration, norm / options.residualScale, length, remaining / options.stepScale});
    if (length == 1 && remaining <= options.stepTolerance * options.stepScale) {
      const Eigen::VectorXd refined = x + trial.correction;
      if (const double refinedNorm = system.residual(refined).norm(); refinedNorm < norm) {
        x = refined;
        report.iterations.back().residual = refinedNorm / options.residualScale;
      }
      return finish(TerminationType::converged);
    }
  }
}

}  // namespace pliant::solvers
