#include "core/solvers/continuation_solver.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/solvers/hermite_curve.hpp"

namespace pliant::solvers {

namespace {

constexpr int maximumCorrections = 25;
/// Corrections that shrink less than this from one to the next are not worth going on with: new factors cost about as
/// much as ten corrections.
constexpr double slowContraction = 0.3;
/// How near a step, relative to its length, must pass by the first point for the branch to be closed.
constexpr double closingDistance = 0.01;
/// What the first contraction after a prediction should be: larger steps save points, smaller ones corrections.
constexpr double targetContraction = 0.1;
/// Points, with their tangents, that a prediction is extrapolated from.
constexpr std::size_t predictionPoints = 3;

double angleBetween(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return 2 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

/// Length of the arc between two points whose tangents differ by `angle`.
double arcBetween(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double angle) {
  const double half = 0.5 * angle;
  return (a - b).norm() * (half > 1e-4 ? half / std::sin(half) : 1.0);
}

}  // namespace

ContinuationSolver::ContinuationSolver(ContinuationProblem& problem, const ContinuationOptions& options)
    : problem_(problem), options_(options) {}

bool ContinuationSolver::inRange(const Point& point) const {
  const double parameter = point.parameter() * options_.parameterScale;
  return parameter >= options_.lower && parameter <= options_.upper;
}

BranchPoint ContinuationSolver::unscaled(const Point& point) const {
  const Eigen::Index n = point.y.size() - 1;
  BranchPoint result;
  result.x = options_.stateScale * point.y.head(n);
  result.parameter = options_.parameterScale * point.y[n];
  if (point.tangent.size() > 0) {
    result.direction = options_.stateScale * point.tangent.head(n);
    result.parameterDirection = options_.parameterScale * point.tangent[n];
  }
  result.arcLength = point.arcLength;
  result.residual = point.residual;
  result.correction = point.correction;
  result.iterations = point.iterations;
  return result;
}

/// Factors of ∂h/∂x at `y`, where it was linearised last.
bool ContinuationSolver::refactorize(const Vector& y) {
  factorized_ = problem_.factorize();
  if (!factorized_) return false;
  parameterColumn_ = problem_.solve(parameterDerivative_) * (options_.parameterScale / options_.stateScale);
  factorPoint_ = y;
  return true;
}

ContinuationSolver::Point ContinuationSolver::scaled(const BranchPoint& point) const {
  const Eigen::Index n = point.x.size();
  Point result;
  result.y.resize(n + 1);
  result.y << point.x / options_.stateScale, point.parameter / options_.parameterScale;
  result.tangent.resize(n + 1);
  result.tangent << point.direction / options_.stateScale, point.parameterDirection / options_.parameterScale;
  result.arcLength = point.arcLength;
  return result;
}

bool ContinuationSolver::factorizeAt(const BranchPoint& point) {
  parameterDerivative_ = problem_.linearize(point.x, point.parameter);
  return refactorize(scaled(point).y);
}

/// The solution (in scaled variables) of [∂h/∂x, ∂h/∂λ; normalᵀ] dy = [f; g] with the factors that there are.
ContinuationSolver::Vector ContinuationSolver::solveBordered(const Vector& f, double g, const Vector& normal) {
  const Eigen::Index n = f.size();
  const Vector w = problem_.solve(f) / options_.stateScale;
  Vector dy(n + 1);
  dy[n] = (g - normal.head(n).dot(w)) / (normal[n] - normal.head(n).dot(parameterColumn_));
  dy.head(n) = w - dy[n] * parameterColumn_;
  return dy;
}

/// ∂h/∂x and ∂h/∂λ at a point that a linearisation led to: in the beginning that at `from`, from where it was predicted
/// `step` away (if not null), later the one whose factors made the corrections.
ContinuationSolver::Vector ContinuationSolver::linearizeForetold(const Point& point, const Point* from, double step) {
  const Eigen::Index n = point.y.size() - 1;
  const Vector x = options_.stateScale * point.y.head(n);
  const double parameter = options_.parameterScale * point.y[n];
  if (point.iterations == 0 && from) return problem_.linearizePrediction(x, parameter, unscaled(*from), step);
  if (point.iterations == 0 || !factorized_) return problem_.linearize(x, parameter);
  Point last;
  last.y = factorPoint_;
  last.tangent = point.y - factorPoint_;
  return problem_.linearizePrediction(x, parameter, unscaled(last), 1);
}

/// Moves `point.y` within the plane normal to `normal` until h vanishes. `point.y` was predicted `step` beyond `from`,
/// if that is not null.
ContinuationSolver::Status ContinuationSolver::correct(Point& point, const Vector& normal, const Point* from,
                                                       double step) {
  const Eigen::Index n = point.y.size() - 1;
  double previous = 0;
  int corrections = 2;  // made with the factors that there are
  bool outdated = !factorized_ || (point.y - factorPoint_).norm() > reuseRadius_;
  bool settled = false;
  point.correction = 0;
  for (point.iterations = 0;; ++point.iterations) {
    if (context_->cancelRequested()) return Status::cancelled;
    const Vector x = options_.stateScale * point.y.head(n);
    const double parameter = options_.parameterScale * point.y[n];
    const Vector h = problem_.residual(x, parameter);
    point.residual = h.norm() / problem_.residualScale(parameter);
    if (!std::isfinite(point.residual)) return Status::failed;
    if (point.residual <= options_.tolerance || settled) return Status::converged;
    if (point.iterations == maximumCorrections) return Status::failed;
    if (outdated) {
      parameterDerivative_ = linearizeForetold(point, from, step);
      if (!refactorize(point.y)) return Status::failed;
      outdated = false;
      corrections = 0;
      previous = 0;
    }
    const Vector correction = solveBordered(-h, 0, normal);
    const double size = correction.norm();
    if (!std::isfinite(size)) return Status::failed;
    const double contraction = previous > 0 ? size / previous : 0;
    if (contraction >= 1) {  // no progress: drop the correction, and try again with new factors if that is new
      if (previous <= options_.roundingTolerance && corrections > 1) return Status::converged;
      if (corrections < 2) return Status::failed;
      outdated = true;
      continue;
    }
    point.y += correction;
    ++corrections;
    if (point.iterations > 0 && previous > options_.roundingTolerance)
      contractionRate_ = contraction / std::max((point.y - factorPoint_).norm(), 1e-300);
    outdated = contraction > slowContraction && size > options_.roundingTolerance;
    previous = size;
    point.correction = size;
    settled = size <= options_.stepTolerance;
  }
}

/// The unit tangent at a solution, from the exact Jacobian there, by refinement with the factors that there are.
ContinuationSolver::Status ContinuationSolver::findTangent(Point& point, const Vector& normal, double tolerance) {
  const Eigen::Index n = point.y.size() - 1;
  parameterDerivative_ =
      problem_.linearize(options_.stateScale * point.y.head(n), options_.parameterScale * point.y[n]);
  if (!factorized_ && !refactorize(point.y)) return Status::failed;
  Vector tangent = normal;
  double previous = 0;
  bool fresh = false;
  for (int iteration = 0; iteration < maximumCorrections; ++iteration) {
    if (context_->cancelRequested()) return Status::cancelled;
    const Vector defect = -(problem_.multiply(options_.stateScale * tangent.head(n)) +
                            options_.parameterScale * tangent[n] * parameterDerivative_);
    const Vector correction = solveBordered(defect, 1 - normal.dot(tangent), normal);
    const double size = correction.norm();
    if (!std::isfinite(size)) return Status::failed;
    if (previous > 0 && size > slowContraction * previous && !fresh) {
      if (!refactorize(point.y)) return Status::failed;
      fresh = true;
      previous = 0;
      continue;
    }
    tangent += correction;
    if (size <= tolerance * tangent.norm()) break;
    previous = size;
  }
  point.tangent = tangent.normalized();
  return point.tangent.allFinite() ? Status::converged : Status::failed;
}

/// A solution with its tangent and monitors, from a prediction.
ContinuationSolver::Status ContinuationSolver::solveAt(Point& point, const Vector& predicted, const Vector& normal,
                                                       const Point* from, double step, double tangentTolerance) {
  point.y = predicted;
  Status status = correct(point, normal, from, step);
  if (status == Status::converged) status = findTangent(point, normal, tangentTolerance);
  if (status == Status::converged) point.monitors = problem_.monitors(unscaled(point));
  return status;
}

/// The next point, `step` beyond the last of `history`; `growth` is the factor by which the step should change.
ContinuationSolver::Status ContinuationSolver::advance(const std::vector<Point>& history, double step, Point& to,
                                                       double& growth) {
  const Point& from = history.back();
  HermiteCurve curve;
  for (const Point& point : history) curve.add(point.arcLength, point.y, point.tangent);
  const Vector predicted = curve.value(from.arcLength + step);
  const Vector normal = curve.derivative(from.arcLength + step).normalized();
  const Status status = solveAt(to, predicted, normal, &from, step, predictingTangentTolerance);
  if (status != Status::converged) return status;
  const double angle = angleBetween(from.tangent, to.tangent);
  to.arcLength = from.arcLength + arcBetween(from.y, to.y, angle);
  // A jump to another branch shows as a sharp turn, or as a correction of the size of the step.
  const double distance = (to.y - predicted).norm();
  const bool near = distance <= 0.5 * step;
  // The prediction's error grows with a power of the step, and the first contraction with fresh factors with the error.
  const double contraction = std::max(contractionRate_ * distance, 1e-12);
  growth = std::min(std::pow(targetContraction / contraction, 0.5 / static_cast<double>(history.size())),
                    options_.targetAngle / std::max(angle, 1e-12));
  return near && angle <= options_.maximumAngle ? Status::converged : Status::failed;
}

ContinuationSolver::Vector ContinuationSolver::startNormal(Eigen::Index n) const {
  if (options_.startDirection.size() == 0) return Vector::Unit(n + 1, n) * (options_.orientation < 0 ? -1.0 : 1.0);
  Vector normal(n + 1);
  normal << options_.startDirection / options_.stateScale, options_.startParameterDirection / options_.parameterScale;
  return normal.normalized();
}

/// The first point of the branch again, if the branch passes through it between two later ones.
std::optional<ContinuationSolver::Point> ContinuationSolver::closingPoint(const Point& first, const Point& from,
                                                                          const Point& to) const {
  const Vector chord = to.y - from.y;
  const double share = (first.y - from.y).dot(chord) / chord.squaredNorm();
  if (from.arcLength <= first.arcLength || share <= 0 || share > 1 || first.tangent.dot(chord) <= 0)
    return std::nullopt;
  HermiteCurve cubic;
  cubic.add(from.arcLength, from.y, from.tangent);
  cubic.add(to.arcLength, to.y, to.tangent);
  double position = from.arcLength + share * (to.arcLength - from.arcLength);
  const Vector rate = cubic.derivative(position);
  position += (first.y - cubic.value(position)).dot(rate) / rate.squaredNorm();
  if ((first.y - cubic.value(position)).norm() > closingDistance * chord.norm()) return std::nullopt;
  Point closing = first;
  closing.arcLength = position;
  return closing;
}

base::SolverReport ContinuationSolver::trace(const Eigen::VectorXd& x, double parameter,
                                             base::ExecutionContext& context, const PointCallback& onPoint) {
  using base::TerminationType;
  const base::Stopwatch watch;
  base::SolverReport report;
  const auto finish = [&](TerminationType termination, const char* message = "") {
    report.termination = termination;
    report.message = message;
    report.seconds = watch.seconds();
    return report;
  };
  const auto emit = [&](const Point& point, double step, BranchEvent kind, int monitor) {
    report.iterations.push_back({static_cast<int>(report.iterations.size()), point.residual, step, point.correction});
    onPoint(unscaled(point), kind, monitor);
  };
  context_ = &context;
  factorized_ = false;

  const Eigen::Index n = x.size();
  Point current;
  current.y.resize(n + 1);
  current.y << x / options_.stateScale, parameter / options_.parameterScale;
  Status status = solveAt(current, Vector(current.y), startNormal(n), nullptr, 0, exactTangentTolerance);
  if (status == Status::cancelled) return finish(TerminationType::cancelled, "The continuation was cancelled.");
  if (status != Status::converged)
    return finish(TerminationType::failed, "The starting point is no solution that a branch can be followed from.");
  emit(current, 0, BranchEvent::none, -1);
  if (problem_.ends()) return finish(TerminationType::converged);

  std::vector<Point> history = {current};
  double step = options_.initialStep;
  while (static_cast<int>(report.iterations.size()) < options_.maximumPoints) {
    reuseRadius_ = 0.02 * step;
    const double rate = std::abs(history.back().tangent[n]) * options_.parameterScale;
    step = std::min({step, options_.maximumStep, options_.maximumParameterStep / std::max(rate, 1e-300)});
    Point next;
    double growth = 1;
    std::vector<Event> events;
    status = advance(history, step, next, growth);
    if (status == Status::converged) status = locateEvents(history.back(), next, events);
    if (status == Status::cancelled) return finish(TerminationType::cancelled, "The continuation was cancelled.");
    if (status == Status::failed) {
      step *= 0.5;
      if (step < options_.minimumStep)
        return finish(
            TerminationType::failed, "The continuation is stuck: no step, however short, reaches a solution.");
      continue;
    }
    const std::optional<Point> closing = closingPoint(current, history.back(), next);
    for (const Event& event : events) {
      if (closing && event.point.arcLength >= closing->arcLength) continue;
      emit(event.point, step, event.kind, event.monitor);
      if (event.end || problem_.ends()) return finish(TerminationType::converged);
    }
    if (closing) {
      emit(*closing, step, BranchEvent::none, -1);
      return finish(TerminationType::converged);
    }
    step *= std::clamp(growth, 0.3, 3.0);
    history.push_back(next);
    if (history.size() > predictionPoints) history.erase(history.begin());
  }
  return finish(TerminationType::iterationLimit, "The continuation reached its limit of points.");
}

}  // namespace pliant::solvers
