#include "core/solvers/wolfe_search.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::solvers {

namespace {

constexpr double sufficientDescent = 1e-4;
constexpr double flattening = 0.9;
constexpr int mostEvaluations = 30;

struct StepPoint {
  double step;
  LineValue at;
};

/// Where the cubic through two values and slopes is least, kept a tenth of the bracket away from its ends.
double interpolate(const StepPoint& a, const StepPoint& b) {
  const double width = b.step - a.step;
  const double d1 = a.at.slope + b.at.slope - 3 * (a.at.value - b.at.value) / (a.step - b.step);
  const double d2 = std::sqrt(d1 * d1 - a.at.slope * b.at.slope) * (width > 0 ? 1 : -1);
  double step = b.step - width * (b.at.slope + d2 - d1) / (b.at.slope - a.at.slope + 2 * d2);
  const double low = std::min(a.step, b.step) + 0.1 * std::abs(width);
  const double high = std::max(a.step, b.step) - 0.1 * std::abs(width);
  if (!std::isfinite(step)) step = 0.5 * (a.step + b.step);
  return std::clamp(step, low, high);
}

}  // namespace

std::optional<double> searchWolfe(const std::function<std::optional<LineValue>(double)>& evaluate, LineValue start,
                                  double first, double longest) {
  const auto isLow = [&](const StepPoint& p) {
    return p.at.value <= start.value + sufficientDescent * p.step * start.slope;
  };
  const auto isFlat = [&](const StepPoint& p) { return std::abs(p.at.slope) <= flattening * std::abs(start.slope); };
  StepPoint low{0, start};        // the best step so far that fulfils the first condition
  std::optional<StepPoint> high;  // the other end of the bracket, once there is one; its value may be missing
  double edge = longest;          // no step from here on has a value
  bool edgeHasValue = true;
  double step = std::min(first, longest), last = 0;
  for (int count = 0; count < mostEvaluations; ++count) {
    const std::optional<LineValue> value = evaluate(step);
    last = step;
    if (!value) {
      edge = step;
      edgeHasValue = false;
      high.reset();
      step = 0.5 * (low.step + edge);
      if (edge - low.step < 1e-3 * edge || step < 1e-10 * first) break;
      continue;
    }
    const StepPoint trial{step, *value};
    if (!isLow(trial) || (low.step > 0 && trial.at.value >= low.at.value)) {
      high = trial;
    } else if (isFlat(trial)) {
      return step;
    } else if (high ? trial.at.slope * (high->step - low.step) >= 0 : trial.at.slope >= 0) {
      high = low;
      low = trial;
    } else {
      low = trial;
    }
    if (high) {
      if (std::abs(high->step - low.step) <= 1e-10 * std::max(first, low.step)) break;
      step = interpolate(low, *high);
    } else if (!edgeHasValue) {
      if (edge - low.step < 1e-2 * edge) break;
      step = 0.5 * (low.step + edge);
    } else {
      if (low.step >= longest) return low.step;
      step = std::min(4 * low.step, longest);
    }
  }
  if (low.step == 0) return std::nullopt;
  if (last != low.step) evaluate(low.step);
  return low.step;
}

}  // namespace pliant::solvers
