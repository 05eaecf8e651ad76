#include "core/harmonic/periodic_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/motion_corrector.hpp"
#include "core/harmonic/response_branch.hpp"
#include "core/solvers/continuation_solver.hpp"
#include "core/solvers/static_equilibrium.hpp"

namespace pliant::harmonic {

namespace {

using base::TerminationType;

constexpr int mostFollowedPoints = 200;

/// Motions at one frequency as a branch in the fraction of the drive.
class DriveRamp final : public solvers::ContinuationProblem {
 public:
  DriveRamp(HarmonicBalanceProblem& problem, JacobianSolver& solver, double omega)
      : problem_(problem), solver_(solver), omega_(omega) {}
  ~DriveRamp() override { problem_.setDriveFraction(1); }

  Vector residual(const Vector& z, double fraction) override {
    problem_.setDriveFraction(fraction);
    return problem_.residual(z, omega_);
  }
  double residualScale(double) override { return problem_.forceScale(omega_); }
  Vector linearize(const Vector& z, double fraction) override { return linearize(z, fraction, nullptr); }
  Vector linearizePrediction(const Vector& z, double fraction, const solvers::BranchPoint& from, double step) override {
    const StressSource stresses{
        from.x, from.x + step * from.direction, from.parameter, from.parameter + step * from.parameterDirection};
    return linearize(z, fraction, &stresses);
  }
  Vector multiply(const Vector& v) override { return solver_.multiply(v); }
  bool factorize() override { return solver_.factorize(); }
  Vector solve(const Vector& b) override { return solver_.solve(b); }

 private:
  Vector linearize(const Vector& z, double fraction, const StressSource* stresses) {
    Vector derivative = driveDerivative(z, fraction);
    problem_.setDriveFraction(fraction);
    Vector h;
    solver_.linearize(z, omega_, h, nullptr, stresses);
    return derivative;
  }

  /// ∂h/∂fraction. Only predictions and rates of convergence depend on it, so a central difference will do.
  Vector driveDerivative(const Vector& z, double fraction) {
    constexpr double step = 1e-5;
    return (residual(z, fraction + step) - residual(z, fraction - step)) / (2 * step);
  }

  HarmonicBalanceProblem& problem_;
  JacobianSolver& solver_;
  double omega_;
};

/// Finds one motion; keeps what its stages share.
class MotionSearch {
 public:
  MotionSearch(HarmonicBalanceProblem& problem, double omega, const PeriodicMotionOptions& options,
               base::ExecutionContext& context)
      : problem_(problem), solver_(problem), omega_(omega), options_(options), context_(context) {}

  PeriodicMotion run(const Vector& start) {
    const base::Stopwatch watch;
    motion_.omega = omega_;
    bool done = false;
    if (start.size() > 0) done = newtonFrom(problem_.withoutLeftOut(start), {});
    if (!done && findSteadyState())
      done = newtonFrom(linearResponse(), steady_) || (options_.startScale == 1 && (rampDrive() || followFrequency()));
    motion_.factorization = solver_.factorization();
    motion_.report.seconds = watch.seconds();
    return std::move(motion_);
  }

 private:
  /// True if there is nothing left to try: converged or cancelled.
  bool newtonFrom(const Vector& start, const Vector& predictedFrom) {
    motion_.z = start;
    motion_.report = correctMotion(problem_, solver_, omega_, options_, {predictedFrom, {}, 0, 1}, motion_.z, context_);
    return motion_.report.converged() || motion_.report.termination == TerminationType::cancelled;
  }

  bool findSteadyState() {
    const mechanics::ElasticAssembler& assembler = problem_.assembler();
    const solvers::StaticEquilibrium equilibrium = solvers::solveStaticEquilibrium(
        problem_.model(), assembler, problem_.steadyConfiguration(), problem_.steadyForce(), {}, context_);
    steady_ = problem_.constantCoefficients(equilibrium.positions);
    if (equilibrium.report.converged()) return true;
    motion_.z = steady_;
    motion_.report = equilibrium.report;
    return false;
  }

  /// The motion that the drive would cause if the model answered linearly about its steady state, scaled as wanted.
  Vector linearResponse() {
    DriveRamp ramp(problem_, solver_, omega_);
    const Vector derivative = ramp.linearize(steady_, 0);
    if (!solver_.factorize()) return steady_;
    const Vector response = solver_.solve(derivative);
    return response.allFinite() ? Vector(steady_ - options_.startScale * response) : steady_;
  }

  bool rampDrive() {
    context_.log(
        base::Severity::information, "Newton's method found no motion from rest; the drive is ramped up step by step.");
    DriveRamp ramp(problem_, solver_, omega_);
    solvers::ContinuationOptions continuation;
    continuation.lower = -1;  // only the end counts: the branch may turn back on its way
    continuation.stateScale = std::max((linearResponse() - steady_).norm(), 1e-9 * steady_.norm());
    continuation.initialStep = 0.25;
    continuation.minimumStep = 1e-5;
    continuation.targetAngle = 0.4;
    continuation.maximumAngle = 1.2;
    continuation.tolerance = options_.tolerance;
    continuation.stepTolerance = options_.stepTolerance;
    continuation.maximumPoints = options_.maximumRampSteps;
    solvers::ContinuationSolver solver(ramp, continuation);
    solvers::BranchPoint last;
    motion_.report = solver.trace(
        steady_, 0, context_, [&](const solvers::BranchPoint& point, solvers::BranchEvent, int) { last = point; });
    if (last.x.size() > 0) motion_.z = last.x;
    if (motion_.report.termination == TerminationType::cancelled) return true;
    if (motion_.report.converged() && last.parameter == 1) {
      // Once more with the exact Jacobian there: the report is of Newton's method, and its factors are left behind.
      problem_.setDriveFraction(1);
      return newtonFrom(last.x, {});
    }
    motion_.report.termination = motion_.report.converged() ? TerminationType::failed : motion_.report.termination;
    motion_.report.message = "No periodic motion was found, neither by Newton's method nor by ramping the drive up.";
    return false;
  }

  /// From a frequency below, where the response is small, along the response curve to this one: resonances are reached
  /// that way which a drive ramped up at one frequency misses.
  bool followFrequency() {
    context_.log(base::Severity::information, "The motion is sought along the response from lower frequencies.");
    const base::SolverReport failure = motion_.report;
    for (const double share : {0.8, 0.6, 0.4}) {
      MotionSearch below(problem_, share * omega_, options_, context_);
      if (below.findSteadyState() && below.newtonFrom(below.linearResponse(), below.steady_) &&
          below.motion_.report.converged() && followFrom(below.motion_))
        return true;
      if (context_.cancelRequested()) {
        motion_.report.termination = TerminationType::cancelled;
        return true;
      }
    }
    motion_.report = failure;
    motion_.report.message =
        "No periodic motion was found by Newton's method, by ramping the drive up, or along the response from lower "
        "frequencies.";
    return false;
  }

  bool followFrom(const PeriodicMotion& start) {
    ResponseBranch branch(problem_);
    solvers::ContinuationOptions continuation;
    continuation.lower = 0.5 * start.omega;
    continuation.upper = omega_;
    continuation.stateScale = std::max(problem_.oscillation(start.z).norm(), 1e-9 * start.z.norm());
    continuation.parameterScale = omega_ - start.omega;
    continuation.initialStep = 0.02;
    continuation.targetAngle = 0.4;
    continuation.maximumAngle = 1.2;
    continuation.tolerance = options_.tolerance;
    continuation.stepTolerance = options_.stepTolerance;
    continuation.maximumPoints = mostFollowedPoints;
    solvers::ContinuationSolver solver(branch, continuation);
    solvers::BranchPoint last;
    const base::SolverReport report =
        solver.trace(start.z, start.omega, context_,
                     [&](const solvers::BranchPoint& point, solvers::BranchEvent, int) { last = point; });
    return report.converged() && last.parameter == omega_ && newtonFrom(last.x, {});
  }

  HarmonicBalanceProblem& problem_;
  JacobianSolver solver_;
  double omega_;
  const PeriodicMotionOptions& options_;
  base::ExecutionContext& context_;
  Vector steady_;
  PeriodicMotion motion_;
};

/// Largest distance between the trajectories of a node in two motions, relative to the path's length.
double relativeTrajectoryChange(const HarmonicBalanceProblem& coarse, const Vector& coarseZ,
                                const HarmonicBalanceProblem& fine, const Vector& fineZ) {
  const Model& model = fine.model();
  std::vector<int> nodes;
  for (const mechanics::Probe& probe : model.probes) nodes.push_back(probe.node);
  if (nodes.empty())
    for (int node = 0; node < model.nodeCount(); ++node) nodes.push_back(node);
  const Vector padded =
      HarmonicBalanceProblem::changeHarmonics(coarseZ, coarse.basis().harmonics(), fine.basis().harmonics());
  double largestChange = 0;
  double longestPath = 0;
  double worst = 0;
  for (const int node : nodes) {
    const Matrix path = fine.nodeTrajectory(fineZ, node);
    const double change = (path - fine.nodeTrajectory(padded, node)).rowwise().norm().maxCoeff();
    double length = 0;
    for (Eigen::Index i = 0; i < path.rows(); ++i) length += (path.row((i + 1) % path.rows()) - path.row(i)).norm();
    largestChange = std::max(largestChange, change);
    longestPath = std::max(longestPath, length);
    if (length > 0) worst = std::max(worst, change / length);
  }
  // Nodes that hardly move count against the longest path where nobody asked for them by name.
  return model.probes.empty() ? (longestPath > 0 ? largestChange / longestPath : 0.0) : worst;
}

}  // namespace

PeriodicMotion solvePeriodicMotion(HarmonicBalanceProblem& problem, double omega, const PeriodicMotionOptions& options,
                                   base::ExecutionContext& context, const Vector& start) {
  return MotionSearch(problem, omega, options, context).run(start);
}

std::pair<HarmonicBalanceProblem, PeriodicMotion> solveWithAdaptiveHarmonics(HarmonicBalanceProblem problem,
                                                                             double omega, double relativeChange,
                                                                             int maximumHarmonics,
                                                                             const PeriodicMotionOptions& options,
                                                                             base::ExecutionContext& context) {
  PeriodicMotion motion = solvePeriodicMotion(problem, omega, options, context);
  while (motion.report.converged()) {
    const int harmonics = problem.basis().harmonics();
    if (harmonics >= maximumHarmonics) {
      motion.report.termination = TerminationType::iterationLimit;
      motion.report.message = "It is not certain that " + std::to_string(harmonics) +
                              " harmonics, the most allowed, are enough: the trajectories still change.";
      break;
    }
    const int more = std::min(harmonics + 2, maximumHarmonics);
    HarmonicBalanceProblem finer(problem.sharedModel(), {more, std::max(problem.basis().samples(), 4 * more + 1)});
    PeriodicMotion finerMotion = solvePeriodicMotion(
        finer, omega, options, context, HarmonicBalanceProblem::changeHarmonics(motion.z, harmonics, more));
    const bool settled = finerMotion.report.converged() && more == harmonics + 2 &&
                         relativeTrajectoryChange(problem, motion.z, finer, finerMotion.z) <= relativeChange;
    problem = std::move(finer);
    motion = std::move(finerMotion);
    if (settled) break;
  }
  return {std::move(problem), std::move(motion)};
}

}  // namespace pliant::harmonic
