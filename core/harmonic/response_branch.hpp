#pragma once

#include "core/harmonic/floquet_stability.hpp"
#include "core/harmonic/jacobian_solver.hpp"
#include "core/solvers/continuation_solver.hpp"

namespace pliant::harmonic {

/// The motions of a problem as a branch in the frequency of the drive, with dA/ds of every probe's path length as
/// monitors, or of the norm of the oscillation if there is no probe.
class ResponseBranch final : public solvers::ContinuationProblem {
 public:
  explicit ResponseBranch(const HarmonicBalanceProblem& problem) : problem_(problem), solver_(problem) {}

  Vector residual(const Vector& z, double omega) override { return problem_.residual(z, omega); }
  double residualScale(double omega) override { return problem_.forceScale(omega); }
  Vector linearize(const Vector& z, double omega) override;
  Vector linearizePrediction(const Vector& z, double omega, const solvers::BranchPoint& from, double step) override;
  Vector multiply(const Vector& v) override { return solver_.multiply(v); }
  bool factorize() override { return solver_.factorize(); }
  Vector solve(const Vector& b) override { return solver_.solve(b); }
  Vector monitors(const solvers::BranchPoint& point) override;
  bool ends() override { return ended_; }

  /// Of the motion that the factors belong to.
  Stability stability(double omega) const { return floquetStability(problem_, solver_, omega); }
  /// The branch is to end with the point that is being received.
  void end() { ended_ = true; }

 private:
  const HarmonicBalanceProblem& problem_;
  JacobianSolver solver_;
  bool ended_ = false;
};

}  // namespace pliant::harmonic
