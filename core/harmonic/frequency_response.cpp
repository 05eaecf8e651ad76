#include "core/harmonic/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/error.hpp"
#include "core/harmonic/jacobian_solver.hpp"
#include "core/harmonic/stability_tracker.hpp"
#include "core/solvers/continuation_solver.hpp"

namespace pliant::harmonic {

namespace {

class ResponseBranch final : public solvers::ContinuationProblem {
 public:
  explicit ResponseBranch(const HarmonicBalanceProblem& problem) : problem_(problem), solver_(problem) {}

  Vector residual(const Vector& z, double omega) override { return problem_.residual(z, omega); }
  double residualScale(double omega) override { return problem_.forceScale(omega); }
  Vector linearize(const Vector& z, double omega) override {
    Vector h, frequencyDerivative;
    solver_.linearize(z, omega, h, &frequencyDerivative);
    return frequencyDerivative;
  }
  Vector linearizePrediction(const Vector& z, double omega, const solvers::BranchPoint& from, double step) override {
    const StressSource stresses{from.x, from.x + step * from.direction};
    Vector h, frequencyDerivative;
    solver_.linearize(z, omega, h, &frequencyDerivative, &stresses);
    return frequencyDerivative;
  }
  Vector multiply(const Vector& v) override { return solver_.multiply(v); }
  bool factorize() override { return solver_.factorize(); }
  Vector solve(const Vector& b) override { return solver_.solve(b); }
  /// With the factors of ∂h/∂z there.
  Stability stability(double omega) const { return floquetStability(problem_, solver_, omega); }

  /// dA/ds of every probe, or of the norm of the oscillation if there is none.
  Vector monitors(const solvers::BranchPoint& point) override {
    const auto& probes = problem_.model().probes;
    if (probes.empty()) return Vector::Constant(1, problem_.oscillation(point.x).dot(point.direction));
    Vector rates(static_cast<Eigen::Index>(probes.size()));
    for (std::size_t p = 0; p < probes.size(); ++p)
      rates[static_cast<Eigen::Index>(p)] = pathLengthGradient(problem_, point.x, probes[p].node).dot(point.direction);
    return rates;
  }

 private:
  const HarmonicBalanceProblem& problem_;
  JacobianSolver solver_;
};

void checkRange(const FrequencyResponseOptions& options) {
  if (!(std::isfinite(options.from) && std::isfinite(options.to) && options.from > 0 && options.to > 0))
    throw base::InputError("", "the frequencies of a response curve must be finite and above 0");
  if (options.from == options.to) throw base::InputError("", "the frequency range of a response curve is empty");
}

solvers::ContinuationOptions continuationOptions(const HarmonicBalanceProblem& problem,
                                                 const FrequencyResponseOptions& options, const Vector& z) {
  const double range = std::abs(options.to - options.from);
  const double swing = problem.oscillation(z).norm();
  solvers::ContinuationOptions continuation;
  continuation.lower = std::min(options.from, options.to);
  continuation.upper = std::max(options.from, options.to);
  continuation.orientation = options.to > options.from ? 1 : -1;
  continuation.stateScale = swing > 0 ? swing : 1.0;
  continuation.parameterScale = range;
  continuation.initialStep = options.initialStep > 0 ? options.initialStep : 0.005;
  continuation.minimumStep = options.minimumStep > 0 ? options.minimumStep : continuation.initialStep / 4096;
  if (options.maximumStep > 0) continuation.maximumStep = options.maximumStep;
  continuation.maximumParameterStep = range / 40;
  continuation.tolerance = options.newton.tolerance;
  continuation.stepTolerance = options.newton.stepTolerance;
  continuation.locationTolerance = options.locationTolerance;
  continuation.maximumPoints = options.maximumPoints;
  return continuation;
}

PointKind kindOf(solvers::BranchEvent event) {
  if (event == solvers::BranchEvent::fold) return PointKind::fold;
  return event == solvers::BranchEvent::monitor ? PointKind::peak : PointKind::regular;
}

ResponsePoint responsePoint(const HarmonicBalanceProblem& problem, TrackedPoint&& tracked) {
  ResponsePoint point;
  point.kind = tracked.kind;
  point.probe = tracked.probe;
  point.omega = tracked.at.parameter;
  point.arcLength = tracked.at.arcLength;
  point.z = std::move(tracked.at.x);
  for (const mechanics::Probe& probe : problem.model().probes)
    point.amplitudes.push_back(amplitude(problem, point.z, probe.node));
  point.residual = tracked.at.residual;
  point.correction = tracked.at.correction;
  point.newtonIterations = tracked.at.iterations;
  point.stability = std::move(tracked.stability);
  return point;
}

}  // namespace

FrequencyResponse traceFrequencyResponse(HarmonicBalanceProblem& problem, const FrequencyResponseOptions& options,
                                         base::ExecutionContext& context,
                                         const std::function<void(const ResponsePoint&)>& onPoint) {
  checkRange(options);
  FrequencyResponse response;
  const PeriodicMotion start = solvePeriodicMotion(problem, options.from, options.newton, context);
  if (!start.report.converged()) {
    response.report = start.report;
    response.report.iterations.clear();
    return response;
  }
  ResponseBranch branch(problem);
  solvers::ContinuationSolver solver(branch, continuationOptions(problem, options, start.z));
  std::vector<base::IterationRecord> records;
  const auto emit = [&](TrackedPoint&& tracked) {
    const double before = response.points.empty() ? 0.0 : response.points.back().arcLength;
    response.points.push_back(responsePoint(problem, std::move(tracked)));
    const ResponsePoint& point = response.points.back();
    records.push_back({static_cast<int>(records.size()), point.residual, point.arcLength - before, point.correction});
    char message[80];
    std::snprintf(message, sizeof message, "ω = %.4g rad/s, arc length %.3g, %zu points", point.omega, point.arcLength,
                  response.points.size());
    context.reportProgress(std::abs(point.omega - options.from) / std::abs(options.to - options.from), message);
    if (onPoint) onPoint(point);
  };
  const auto stability = [&](const solvers::BranchPoint& at) {
    return options.stability && !context.cancelRequested() && solver.factorizeAt(at) ? branch.stability(at.parameter)
                                                                                     : Stability{};
  };
  const auto between = [&](const solvers::BranchPoint& from, const solvers::BranchPoint& to, double arcLength) {
    return solver.solveBetween(from, to, arcLength);
  };
  StabilityTracker tracker({stability, between, emit}, options.locationTolerance);
  const bool probes = !problem.model().probes.empty();
  response.report = solver.trace(
      start.z, options.from, context, [&](const solvers::BranchPoint& at, solvers::BranchEvent event, int monitor) {
        tracker.add(at, kindOf(event), probes ? monitor : -1);
      });
  tracker.finish();
  response.report.iterations = std::move(records);
  response.report.seconds += start.report.seconds;
  return response;
}

}  // namespace pliant::harmonic
