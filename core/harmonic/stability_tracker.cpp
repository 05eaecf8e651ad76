#include "core/harmonic/stability_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant::harmonic {

namespace {

constexpr int mostEvaluations = 40;
/// How near -1, in radians, the argument of a multiplier counts as π: exact only with infinitely many harmonics.
constexpr double angleOfMinusOne = 0.03;
/// Points next to a fold, as shares of the way to it, where the stability on its two sides is looked at.
constexpr double nextToFold = 0.2;

bool known(const TrackedPoint& point) { return point.stability.state != StabilityState::unknown; }

/// Growth of the multiplier with this index by falling modulus: of the one that changes sides if their number changes
/// from `index` to more. Continuous along a curve.
double growth(const TrackedPoint& point, std::size_t index) {
  const auto& multipliers = point.stability.multipliers;
  return index < multipliers.size() ? std::log(std::abs(multipliers[index])) - unitCircleTolerance : -1.0;
}

PointKind kindOf(std::complex<double> multiplier) {
  if (multiplier.imag() == 0 && multiplier.real() > 0) return PointKind::branchPoint;
  return std::numbers::pi - std::abs(std::arg(multiplier)) < angleOfMinusOne ? PointKind::periodDoubling
                                                                             : PointKind::neimarkSacker;
}

int multiplicity(PointKind kind) { return kind == PointKind::neimarkSacker ? 2 : 1; }

void setCount(Stability& stability, int count) {
  stability.unstableCount = count;
  stability.state = count > 0 ? StabilityState::unstable : StabilityState::stable;
}

}  // namespace

StabilityTracker::StabilityTracker(Functions functions, double tolerance)
    : functions_(std::move(functions)), tolerance_(tolerance) {}

TrackedPoint StabilityTracker::regularPoint(const solvers::BranchPoint& at) const {
  return {at, PointKind::regular, -1, functions_.stability(at)};
}

void StabilityTracker::add(const solvers::BranchPoint& at, PointKind kind, int probe) {
  TrackedPoint point{at, kind, probe, {}};
  if (kind == PointKind::fold) {
    folds_.push_back(std::move(point));
    return;
  }
  point.stability = functions_.stability(at);
  Points between;
  if (last_ && known(*last_) && known(point)) {
    if (folds_.empty())
      addBifurcations(*last_, point, between);
    else
      addBifurcationsAroundFold(*last_, point, folds_.front(), between);
    const int count = std::min(last_->stability.unstableCount, point.stability.unstableCount);
    for (TrackedPoint& fold : folds_) setCount(fold.stability, count);
  }
  std::move(folds_.begin(), folds_.end(), std::back_inserter(between));
  folds_.clear();
  std::stable_sort(between.begin(), between.end(),
                   [](const TrackedPoint& a, const TrackedPoint& b) { return a.at.arcLength < b.at.arcLength; });
  for (TrackedPoint& found : between) functions_.emit(std::move(found));
  last_ = point;
  functions_.emit(std::move(point));
}

void StabilityTracker::finish() {
  for (TrackedPoint& fold : folds_) functions_.emit(std::move(fold));
  folds_.clear();
}

/// The point between two others where the multiplier `index` crosses the unit circle (Illinois method).
std::optional<TrackedPoint> StabilityTracker::locate(const TrackedPoint& from, const TrackedPoint& to,
                                                     std::size_t index) const {
  TrackedPoint a = from;
  TrackedPoint b = to;
  double fa = growth(a, index);
  double fb = growth(b, index);
  int side = 0;
  double lastPosition = -1;
  const double whole = to.at.arcLength - from.at.arcLength;
  for (int evaluation = 0; evaluation < mostEvaluations; ++evaluation) {
    const double length = b.at.arcLength - a.at.arcLength;
    const double position = a.at.arcLength + length * std::clamp(fa / (fa - fb), 0.01, 0.99);
    const auto at = functions_.between(a.at, b.at, position);
    if (!at) return std::nullopt;
    TrackedPoint root = regularPoint(*at);
    if (!known(root)) return std::nullopt;
    const double f = growth(root, index);
    const double moved = lastPosition < 0 ? length : std::min(std::abs(position - lastPosition), length);
    // Near a fold, where the frequency hardly changes, the place on the curve has to be right as well.
    if (f == 0 || (moved <= 1e-4 * whole &&
                   moved * std::abs(at->parameterDirection) <= 0.1 * tolerance_ * std::abs(at->parameter)))
      return root;
    lastPosition = position;
    if ((f > 0) == (fa > 0)) {
      a = std::move(root);
      fa = f;
      if (side == -1) fb *= 0.5;
      side = -1;
    } else {
      b = std::move(root);
      fb = f;
      if (side == 1) fa *= 0.5;
      side = 1;
    }
  }
  return std::nullopt;
}

void StabilityTracker::addBifurcations(const TrackedPoint& from, const TrackedPoint& to, Points& into) const {
  const int before = from.stability.unstableCount;
  const int after = to.stability.unstableCount;
  if (before == after) return;
  const int fewer = std::min(before, after);
  const auto index = static_cast<std::size_t>(fewer);
  auto bifurcation = locate(from, to, index);
  if (!bifurcation) return;
  bifurcation->kind = kindOf(bifurcation->stability.multipliers[index]);
  // Beyond the multiplier that was followed there may be others that change sides.
  TrackedPoint moreUnstable = *bifurcation;
  setCount(bifurcation->stability, fewer);
  setCount(moreUnstable.stability, fewer + multiplicity(bifurcation->kind));
  into.push_back(std::move(*bifurcation));
  if (moreUnstable.stability.unstableCount >= std::max(before, after)) return;
  if (after > before)
    addBifurcations(moreUnstable, to, into);
  else
    addBifurcations(from, moreUnstable, into);
}

void StabilityTracker::addBifurcationsAroundFold(const TrackedPoint& from, const TrackedPoint& to,
                                                 const TrackedPoint& fold, Points& into) const {
  if (std::abs(from.stability.unstableCount - to.stability.unstableCount) == 1) return;
  const auto near = [&](const TrackedPoint& end) {
    return functions_.between(from.at, to.at, fold.at.arcLength + nextToFold * (end.at.arcLength - fold.at.arcLength));
  };
  const auto before = near(from);
  const auto after = near(to);
  if (!before || !after) return;
  const TrackedPoint left = regularPoint(*before);
  const TrackedPoint right = regularPoint(*after);
  if (!known(left) || !known(right)) return;
  addBifurcations(from, left, into);
  addBifurcations(right, to, into);
}

}  // namespace pliant::harmonic
