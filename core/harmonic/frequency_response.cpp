#include "core/harmonic/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/error.hpp"
#include "core/harmonic/jacobian_solver.hpp"
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
  const auto receive = [&](const solvers::BranchPoint& at, solvers::BranchEvent event, int monitor) {
    ResponsePoint point;
    point.kind = event == solvers::BranchEvent::fold      ? PointKind::fold
                 : event == solvers::BranchEvent::monitor ? PointKind::peak
                                                          : PointKind::regular;
    point.probe = problem.model().probes.empty() ? -1 : monitor;
    point.omega = at.parameter;
    point.arcLength = at.arcLength;
    point.z = at.x;
    for (const mechanics::Probe& probe : problem.model().probes)
      point.amplitudes.push_back(amplitude(problem, point.z, probe.node));
    point.residual = at.residual;
    point.correction = at.correction;
    point.newtonIterations = at.iterations;
    response.points.push_back(std::move(point));
    char message[80];
    std::snprintf(message, sizeof message, "ω = %.4g rad/s, arc length %.3g, %zu points", at.parameter, at.arcLength,
                  response.points.size());
    context.reportProgress(std::abs(at.parameter - options.from) / std::abs(options.to - options.from), message);
    if (onPoint) onPoint(response.points.back());
  };
  response.report = solver.trace(start.z, options.from, context, receive);
  response.report.seconds += start.report.seconds;
  return response;
}

}  // namespace pliant::harmonic
