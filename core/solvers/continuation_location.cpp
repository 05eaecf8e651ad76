#include <algorithm>
#include <cmath>

#include "core/solvers/continuation_solver.hpp"
#include "core/solvers/hermite_curve.hpp"

namespace pliant::solvers {

namespace {

constexpr int maximumLocations = 40;

}  // namespace

/// The solution at an arc length between those of two others.
ContinuationSolver::Status ContinuationSolver::solveBetween(const Point& from, const Point& to, double arcLength,
                                                            Point& point) {
  HermiteCurve cubic;
  cubic.add(from.arcLength, from.y, from.tangent);
  cubic.add(to.arcLength, to.y, to.tangent);
  point = Point{};
  const Status status = solveAt(point, cubic.value(arcLength), cubic.derivative(arcLength).normalized(), &from,
                                arcLength - from.arcLength, exactTangentTolerance);
  point.arcLength = arcLength;
  return status;
}

std::optional<BranchPoint> ContinuationSolver::solveBetween(const BranchPoint& from, const BranchPoint& to,
                                                            double arcLength) {
  Point point;
  if (solveBetween(scaled(from), scaled(to), arcLength, point) != Status::converged) return std::nullopt;
  return unscaled(point);
}

/// The root of `function` between two points where it has different signs (Illinois variant of the false position).
ContinuationSolver::Status ContinuationSolver::locate(const Point& from, const Point& to,
                                                      const std::function<double(const Point&)>& function,
                                                      Point& root) {
  Point a = from;
  Point b = to;
  double fa = function(a);
  double fb = function(b);
  const double whole = b.arcLength - a.arcLength;
  int side = 0;
  double lastPosition = -1;
  for (int iteration = 0; iteration < maximumLocations; ++iteration) {
    const double length = b.arcLength - a.arcLength;
    const double u = length * std::clamp(fa / (fa - fb), 0.01, 0.99);
    const double position = a.arcLength + u;
    if (const Status status = solveBetween(a, b, position, root); status != Status::converged) return status;
    const double f = function(root);
    const double parameterRate = std::abs(root.tangent[root.tangent.size() - 1]);
    const double moved = std::min(std::abs(position - lastPosition), length);
    if (f == 0 || (moved <= 1e-4 * whole &&
                   moved * parameterRate <= 0.1 * options_.locationTolerance * std::abs(root.parameter())))
      return Status::converged;
    lastPosition = position;
    if ((f > 0) == (fa > 0)) {
      a = root;
      fa = f;
      if (side == -1) fb *= 0.5;
      side = -1;
    } else {
      b = root;
      fb = f;
      if (side == 1) fa *= 0.5;
      side = 1;
    }
  }
  return Status::failed;
}

/// The solution with λ = bound exactly, between two points on either side of it.
ContinuationSolver::Status ContinuationSolver::locateBound(const Point& from, const Point& to, double bound,
                                                           Point& end) {
  const double scaledBound = bound / options_.parameterScale;
  const Eigen::Index n = from.y.size() - 1;
  HermiteCurve cubic;
  cubic.add(from.arcLength, from.y, from.tangent);
  cubic.add(to.arcLength, to.y, to.tangent);
  double low = from.arcLength;
  double high = to.arcLength;
  const bool rising = from.parameter() < scaledBound;
  for (int bisection = 0; bisection < 60; ++bisection) {
    const double middle = 0.5 * (low + high);
    ((cubic.value(middle)[n] < scaledBound) == rising ? low : high) = middle;
  }
  Vector predicted = cubic.value(high);
  predicted[n] = scaledBound;
  end.y = predicted;
  const Vector fixed = Vector::Unit(n + 1, n);
  Status status = correct(end, fixed, &from, high - from.arcLength);
  if (status == Status::converged)
    status = findTangent(end, cubic.derivative(high).normalized(), predictingTangentTolerance);
  end.arcLength = high;
  return status;
}

/// Folds, monitors and the end of the branch in one step, in their order. `to` becomes the end if there is one.
ContinuationSolver::Status ContinuationSolver::locateEvents(const Point& from, Point& to, std::vector<Event>& events) {
  const Eigen::Index n = from.y.size() - 1;
  const auto rate = [n](const Point& point) { return point.tangent[n]; };
  if (rate(from) * rate(to) < 0) {
    Event fold{{}, BranchEvent::fold, -1, false};
    if (const Status status = locate(from, to, rate, fold.point); status != Status::converged) return status;
    if (inRange(fold.point)) {
      events.push_back(fold);
    } else {
      to = fold.point;  // the branch leaves the range before it turns back
    }
  }
  bool ended = false;
  if (!inRange(to)) {
    const double bound = to.parameter() * options_.parameterScale > options_.upper ? options_.upper : options_.lower;
    Point end;
    if (const Status status = locateBound(from, to, bound, end); status != Status::converged) return status;
    end.monitors = problem_.monitors(unscaled(end));
    to = end;
    ended = true;
    std::erase_if(events, [&](const Event& event) { return event.point.arcLength >= end.arcLength; });
  }
  for (Eigen::Index m = 0; m < from.monitors.size(); ++m) {
    if (!(from.monitors[m] > 0 && to.monitors[m] <= 0)) continue;
    Event event{{}, BranchEvent::monitor, static_cast<int>(m), false};
    const auto monitor = [m](const Point& point) { return point.monitors[m]; };
    if (const Status status = locate(from, to, monitor, event.point); status != Status::converged) return status;
    events.push_back(event);
  }
  events.push_back({to, BranchEvent::none, -1, ended});
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.point.arcLength < b.point.arcLength; });
  return Status::converged;
}

}  // namespace pliant::solvers
