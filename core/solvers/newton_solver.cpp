#include "core/solvers/newton_solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pliant::solvers {

namespace {

constexpr double sufficientDecrease = 1e-4;
constexpr double shortestStep = 1e-6;

/// The step length that a parabola through ½‖r‖² at 0 (with Newton's slope -‖r‖²) and at `length` suggests.
double shorten(double length, double norm, double trialNorm) {
  if (!std::isfinite(trialNorm)) return 0.25 * length;
  const double start = 0.5 * norm * norm;
  const double end = 0.5 * trialNorm * trialNorm;
  const double suggested = start * length * length / (end - start + 2 * start * length);
  return std::clamp(suggested, 0.1 * length, 0.5 * length);
}

}  // namespace

base::SolverReport solveNewton(NonlinearSystem& system, Eigen::VectorXd& x, const NewtonOptions& options,
                               base::ExecutionContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  base::SolverReport report;
  const auto finish = [&](base::TerminationType termination, const char* message = "") {
    report.termination = termination;
    report.message = message;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return report;
  };
  using base::TerminationType;

  double norm = system.residual(x).norm();
  report.iterations.push_back({0, norm / options.residualScale, 0});
  if (!std::isfinite(norm)) return finish(TerminationType::failed, "The residual is not finite at the starting point.");

  Eigen::VectorXd residual;
  for (int iteration = 1;; ++iteration) {
    if (norm <= options.tolerance * options.residualScale) return finish(TerminationType::converged);
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "Newton's method was cancelled.");
    if (iteration > options.maximumIterations)
      return finish(TerminationType::iterationLimit, "Newton's method reached its iteration limit.");
    if (!system.linearize(x, residual)) return finish(TerminationType::failed, "The Jacobian is singular.");
    const Eigen::VectorXd step = -system.solve(residual);
    const double stepNorm = step.norm();
    if (!std::isfinite(stepNorm)) return finish(TerminationType::failed, "The Jacobian is singular.");

    double length = 1;
    Eigen::VectorXd trial = x + step;
    double trialNorm = system.residual(trial).norm();
    const bool settled = stepNorm <= options.stepTolerance * options.stepScale;
    if (settled && !(trialNorm < norm)) return finish(TerminationType::converged);
    while (!(trialNorm <= std::sqrt(1 - 2 * sufficientDecrease * length) * norm) && !settled) {
      length = shorten(length, norm, trialNorm);
      if (length < shortestStep)
        return finish(TerminationType::failed, "The line search found no step that lowers the residual.");
      trial = x + length * step;
      trialNorm = system.residual(trial).norm();
    }
    x = trial;
    norm = trialNorm;
    report.iterations.push_back({iteration, norm / options.residualScale, length});
    if (settled) return finish(TerminationType::converged);
  }
}

}  // namespace pliant::solvers
