#include "core/harmonic/response_tracer.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>

namespace pliant::harmonic {

namespace {

/// How far from a crossing another curve is first looked for, in the scaled measure.
constexpr std::array stepsOfSearch{0.02, 0.05, 0.1};
/// Points this close, scaled, and with frequencies this close, are the same.
constexpr double sameMotion = 2e-3;
constexpr double sameFrequency = 1e-4;

PointKind kindOf(solvers::BranchEvent event) {
  if (event == solvers::BranchEvent::fold) return PointKind::fold;
  return event == solvers::BranchEvent::monitor ? PointKind::peak : PointKind::regular;
}

ResponsePoint responsePoint(const HarmonicBalanceProblem& problem, TrackedPoint&& tracked) {
  ResponsePoint point;
  point.kind = tracked.kind;
  point.probe = tracked.probe;
  point.drivePeriods = problem.drivePeriods();
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

/// Whether one motion is the other seen in a mirror or half a period later, as far as the probes tell.
bool twins(const HarmonicBalanceProblem& problem, const ResponsePoint& a, const solvers::BranchPoint& b) {
  const auto alike = [](double x, double y) { return std::abs(x - y) <= 1e-6 * std::max(std::abs(x), std::abs(y)); };
  if (!alike(a.omega, b.parameter)) return false;
  const auto& probes = problem.model().probes;
  if (probes.empty()) return alike(problem.oscillation(a.z).norm(), problem.oscillation(b.x).norm());
  for (std::size_t p = 0; p < probes.size(); ++p)
    if (!alike(a.amplitudes[p].pathLength, amplitude(problem, b.x, probes[p].node).pathLength)) return false;
  return true;
}

}  // namespace

ResponseTracer::ResponseTracer(const HarmonicBalanceProblem& problem, const FrequencyResponseOptions& options,
                               base::ExecutionContext& context, const PointCallback& onPoint)
    : problem_(std::shared_ptr<const HarmonicBalanceProblem>(), &problem),  // not owned: the caller's counts its cost
      options_(options),
      context_(context),
      onPoint_(onPoint) {}

solvers::ContinuationOptions ResponseTracer::continuationOptions() const {
  const double range = std::abs(options_.to - options_.from);
  solvers::ContinuationOptions continuation;
  continuation.lower = std::min(options_.from, options_.to);
  continuation.upper = std::max(options_.from, options_.to);
  continuation.orientation = options_.to > options_.from ? 1 : -1;
  continuation.stateScale = stateScale_;
  continuation.parameterScale = range;
  continuation.initialStep = options_.initialStep > 0 ? options_.initialStep : 0.005;
  continuation.minimumStep = options_.minimumStep > 0 ? options_.minimumStep : continuation.initialStep / 4096;
  if (options_.maximumStep > 0) continuation.maximumStep = options_.maximumStep;
  continuation.maximumParameterStep = range / 40;
  continuation.tolerance = options_.newton.tolerance;
  continuation.stepTolerance = options_.newton.stepTolerance;
  continuation.locationTolerance = options_.locationTolerance;
  continuation.maximumPoints = options_.maximumPoints;
  return continuation;
}

FrequencyResponse ResponseTracer::run(const Vector& start) {
  const double swing = problem_->oscillation(start).norm();
  stateScale_ = swing > 0 ? swing : 1.0;
  Curve first{problem_};
  response_.report = trace(first, continuationOptions(), start, options_.from);
  for (std::size_t c = 0; c < crossings_.size() && !context_.cancelRequested(); ++c)
    if (!crossings_[c].visited && crossings_[c].depth <= options_.branchDepth) follow(c);
  response_.report.iterations.clear();
  double before = 0;
  for (const ResponsePoint& point : response_.points) {
    response_.report.iterations.push_back({static_cast<int>(response_.report.iterations.size()), point.residual,
                                           std::max(0.0, point.arcLength - before), point.correction});
    before = point.arcLength;
  }
  return std::move(response_);
}

/// Traces the curve that crosses another, in both directions unless they are alike.
void ResponseTracer::follow(std::size_t crossing) {
  // A copy: tracing finds more crossings.
  const Crossing origin = crossings_[crossing];
  const auto departure = departureFrom(origin, stateScale_, std::abs(options_.to - options_.from));
  if (!departure) return;
  crossings_[crossing].visited = true;
  std::optional<ResponsePoint> twin;
  for (const double side : {1.0, -1.0}) {
    // Half a period later, a motion of twice the period is on the other side.
    if (side < 0 && origin.kind == PointKind::periodDoubling) break;
    for (const double step : stepsOfSearch) {
      Curve curve{departure->problem, curves_ + 1, origin.depth, &origin, twin ? &*twin : nullptr};
      solvers::ContinuationOptions continuation = continuationOptions();
      continuation.startDirection = side * departure->direction;
      continuation.startParameterDirection = side * departure->parameterDirection;
      const std::size_t firstPoint = response_.points.size();
      const base::SolverReport report = trace(curve, continuation, departure->z + step * continuation.startDirection,
                                              departure->omega + step * continuation.startParameterDirection);
      response_.report.seconds += report.seconds;
      if (curve.points == 0) continue;
      if (response_.points.size() > firstPoint + 1) {
        ++curves_;
        twin = response_.points[firstPoint + 1];
      }
      if (!report.converged() && response_.report.converged()) {
        response_.report.termination = report.termination;
        response_.report.message = "Of the curves that branch off: " + report.message;
      }
      break;
    }
  }
}

base::SolverReport ResponseTracer::trace(Curve& curve, const solvers::ContinuationOptions& continuation,
                                         const Vector& z, double omega) {
  ResponseBranch branch(*curve.problem);
  solvers::ContinuationSolver solver(branch, continuation);
  const auto stability = [&](const solvers::BranchPoint& at) {
    return options_.stability && !context_.cancelRequested() && solver.factorizeAt(at) ? branch.stability(at.parameter)
                                                                                       : Stability{};
  };
  const auto between = [&](const solvers::BranchPoint& from, const solvers::BranchPoint& to, double arcLength) {
    return solver.solveBetween(from, to, arcLength);
  };
  const auto emitPoint = [&](TrackedPoint&& tracked) { emit(curve, std::move(tracked)); };
  StabilityTracker tracker({stability, between, emitPoint}, options_.locationTolerance);
  const bool probes = !problem_->model().probes.empty();
  base::SolverReport report =
      solver.trace(z, omega, context_, [&](const solvers::BranchPoint& at, solvers::BranchEvent event, int monitor) {
        if (receive(curve, at, tracker))
          tracker.add(at, kindOf(event), probes ? monitor : -1);
        else
          branch.end();
      });
  tracker.finish();
  return report;
}

/// What has to be done before a point is added to a curve that branched off; false if the curve ends there.
bool ResponseTracer::receive(Curve& curve, const solvers::BranchPoint& at, StabilityTracker& tracker) {
  if (!curve.origin) return true;
  ++curve.points;
  if (curve.points == 1) {
    if (curve.twin && twins(*curve.problem, *curve.twin, at)) return false;
    TrackedPoint start{curve.origin->at, PointKind::regular, -1, curve.origin->stability};
    start.at.x = curve.origin->problem->stretched(start.at.x, curve.problem->drivePeriods());
    start.at.arcLength = 0;
    start.at.iterations = 0;
    emit(curve, std::move(start));
    return true;
  }
  if (Crossing* end = crossingAt(curve, at)) {
    end->visited = true;
    tracker.finish();
    emit(curve, {at, PointKind::regular, -1, end->stability});
    return false;
  }
  return true;
}

/// The crossing that a point of a curve is, if it is one.
Crossing* ResponseTracer::crossingAt(const Curve& curve, const solvers::BranchPoint& at) {
  for (Crossing& crossing : crossings_) {
    if (std::abs(crossing.at.parameter - at.parameter) > sameFrequency * at.parameter) continue;
    if (curve.problem->drivePeriods() % crossing.problem->drivePeriods() != 0) continue;
    const Vector z = crossing.problem->stretched(crossing.at.x, curve.problem->drivePeriods());
    if ((z - at.x).norm() <= sameMotion * stateScale_) return &crossing;
  }
  return nullptr;
}

void ResponseTracer::emit(Curve& curve, TrackedPoint&& tracked) {
  const bool crosses = tracked.kind == PointKind::branchPoint || tracked.kind == PointKind::periodDoubling;
  if (crosses && curve.depth < options_.branchDepth && !crossingAt(curve, tracked.at))
    crossings_.push_back({curve.problem, tracked.at, tracked.kind, curve.depth + 1, tracked.stability});
  ResponsePoint point = responsePoint(*curve.problem, std::move(tracked));
  point.branch = curve.index;
  response_.points.push_back(std::move(point));
  const ResponsePoint& added = response_.points.back();
  char message[80];
  std::snprintf(message, sizeof message, "ω = %.4g rad/s, arc length %.3g, %zu points", added.omega, added.arcLength,
                response_.points.size());
  context_.reportProgress(std::abs(added.omega - options_.from) / std::abs(options_.to - options_.from), message);
  if (onPoint_) onPoint_(added);
}

}  // namespace pliant::harmonic
