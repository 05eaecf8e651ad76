#include "core/harmonic/motion_corrector.hpp"

#include <algorithm>

#include "core/solvers/newton_solver.hpp"

namespace pliant::harmonic {

namespace {

class FixedFrequency final : public solvers::NonlinearSystem {
 public:
  FixedFrequency(const HarmonicBalanceProblem& problem, JacobianSolver& solver, double omega, StressSource stresses)
      : problem_(problem), solver_(solver), omega_(omega), stresses_(std::move(stresses)) {}

  Vector residual(const Vector& z) override { return problem_.residual(z, omega_); }
  bool linearize(const Vector& z, Vector& h) override {
    // Each iterate is extrapolated from the one before by linearisation, so the stresses are, too.
    stresses_.to = z;
    solver_.linearize(z, omega_, h, nullptr, stresses_.from.size() > 0 ? &stresses_ : nullptr);
    stresses_ = {z, {}, 1, 1};
    return solver_.factorize();
  }
  Vector solve(const Vector& b) override { return solver_.solve(b); }

 private:
  const HarmonicBalanceProblem& problem_;
  JacobianSolver& solver_;
  double omega_;
  StressSource stresses_;
};

}  // namespace

base::SolverReport correctMotion(const HarmonicBalanceProblem& problem, JacobianSolver& solver, double omega,
                                 const PeriodicMotionOptions& options, StressSource stresses, Vector& z,
                                 base::ExecutionContext& context) {
  FixedFrequency system(problem, solver, omega, std::move(stresses));
  solvers::NewtonOptions newton;
  newton.tolerance = options.tolerance;
  newton.residualScale = problem.forceScale(omega);
  newton.stepTolerance = options.stepTolerance;
  newton.stepScale = std::max(problem.oscillation(z).norm(), 1e-6 * z.norm());
  newton.maximumIterations = options.maximumIterations;
  return solvers::solveNewton(system, z, newton, context);
}

}  // namespace pliant::harmonic
