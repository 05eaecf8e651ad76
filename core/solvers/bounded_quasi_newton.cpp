#include "core/solvers/bounded_quasi_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/base/stopwatch.hpp"
#include "core/solvers/limited_memory_hessian.hpp"
#include "core/solvers/wolfe_search.hpp"

namespace pliant::solvers {

namespace {

using base::TerminationType;
using Eigen::Index;
using Eigen::VectorXd;

/// Where the quadratic model is least for the first time along the projected gradient (algorithm CP), with
/// c = Wᵀ (xᶜ - x).
struct CauchyPoint {
  VectorXd x, c;
};

class BoundedMinimization {
 public:
  BoundedMinimization(BoundedObjective& objective, VectorXd& x, const VectorXd& lower, const VectorXd& upper,
                      const BoundedQuasiNewtonOptions& options, base::ExecutionContext& context,
                      const std::function<void(const BoundedIterate&)>& onIterate)
      : objective_(objective),
        x_(x),
        lower_(lower),
        upper_(upper),
        options_(options),
        context_(context),
        onIterate_(onIterate),
        hessian_(x.size(), options.memory, 1) {}

  base::SolverReport run() {
    const base::Stopwatch watch;
    x_ = projected(x_);
    if (const auto value = evaluate(x_, gradient_)) {
      value_ = *value;
      iterate();
    } else {
      finish(cancelled_ ? TerminationType::cancelled : TerminationType::failed,
             "The objective has no value at the starting point.");
    }
    report_.seconds = watch.seconds();
    return report_;
  }

 private:
  void finish(TerminationType termination, const char* message = "") {
    report_.termination = termination;
    report_.message = message;
  }

  VectorXd projected(const VectorXd& x) const { return x.cwiseMax(lower_).cwiseMin(upper_); }
  double projectedGradient() const { return (projected(x_ - gradient_) - x_).cwiseAbs().maxCoeff(); }

  std::optional<double> evaluate(const VectorXd& x, VectorXd& gradient) {
    if (context_.cancelRequested()) {
      cancelled_ = true;
      return std::nullopt;
    }
    ++evaluations_;
    const auto value = objective_.evaluate(x, gradient);
    return value && std::isfinite(*value) && gradient.allFinite() ? value : std::nullopt;
  }

  void record(int iteration, double stepLength, double decrease) {
    const double norm = projectedGradient();
    report_.iterations.push_back({iteration, norm, stepLength, decrease});
    if (onIterate_) onIterate_({iteration, x_, value_, norm, stepLength, evaluations_});
    context_.reportProgress(static_cast<double>(iteration) / options_.maximumIterations);
  }

  void iterate() {
    record(0, 0, 0);
    const double firstNorm = projectedGradient();
    forget();
    int small = 0;  // iterations in succession that hardly lowered f
    for (int iteration = 1;; ++iteration) {
      if (projectedGradient() <= options_.gradientTolerance * firstNorm) return finish(TerminationType::converged);
      if (iteration > options_.maximumIterations)
        return finish(TerminationType::iterationLimit, "The iteration limit was reached before a minimum.");
      const double before = value_;
      std::optional<double> length = step();
      if (!length && !cancelled_ && !hessian_.empty()) {
        forget();  // the model may be wrong, as where the function is not smooth
        length = step();
      }
      if (cancelled_) return finish(TerminationType::cancelled, "The minimisation was cancelled.");
      if (!length) {
        // Along a descent direction nothing is lower: what is left is below the accuracy of the objective, or values
        // end here.
        if (foretold_ <= options_.valueTolerance * std::abs(value_)) return finish(TerminationType::converged);
        return finish(TerminationType::failed, "The line search found no lower value.");
      }
      const double decrease = (before - value_) / std::max(std::abs(before), std::abs(value_));
      record(iteration, *length, decrease);
      small = decrease <= options_.valueTolerance ? small + 1 : 0;
      if (small == 2) return finish(TerminationType::converged);
    }
  }

  /// Back to a multiple of the identity, by which the first step has the size wanted.
  void forget() {
    VectorXd descent = gradient_;
    for (Index i = 0; i < x_.size(); ++i)
      if (gradient_[i] > 0 ? x_[i] <= lower_[i] : x_[i] >= upper_[i]) descent[i] = 0;
    const double largest = descent.cwiseAbs().maxCoeff();
    hessian_.forget(largest > 0 ? largest / options_.firstStep : 1);
  }

  /// One iteration; its step length, or none if nothing lower was found.
  std::optional<double> step() {
    const CauchyPoint cauchy = findCauchyPoint();
    const VectorXd direction = minimizeOverFree(cauchy) - x_;
    const double slope = gradient_.dot(direction);
    const double size = direction.cwiseAbs().maxCoeff();
    foretold_ = std::abs(slope);
    if (!(slope < 0) || !std::isfinite(size)) return std::nullopt;
    const double longest = longestStep(direction, size);
    VectorXd gradient, trial;
    double value = 0;
    const auto along = [&](double t) -> std::optional<LineValue> {
      trial = projected(x_ + t * direction);  // rounding may leave the bounds
      const auto found = evaluate(trial, gradient);
      if (!found) return std::nullopt;
      value = *found;
      return LineValue{value, gradient.dot(direction)};
    };
    const auto length = searchWolfe(along, {value_, slope}, std::min(1.0, longest), longest);
    if (!length || cancelled_) return std::nullopt;
    hessian_.update(trial - x_, gradient - gradient_);
    x_ = trial;
    value_ = value;
    gradient_ = gradient;
    return length;
  }

  double longestStep(const VectorXd& direction, double size) const {
    double longest = std::min(10.0, options_.maximumStep / size);
    for (Index i = 0; i < x_.size(); ++i) {
      if (direction[i] > 0) longest = std::min(longest, (upper_[i] - x_[i]) / direction[i]);
      if (direction[i] < 0) longest = std::min(longest, (lower_[i] - x_[i]) / direction[i]);
    }
    return longest;
  }

  CauchyPoint findCauchyPoint() const {
    const double theta = hessian_.theta();
    const Eigen::MatrixXd& w = hessian_.w();
    constexpr double never = std::numeric_limits<double>::infinity();
    VectorXd direction = -gradient_;
    std::vector<std::pair<double, Index>> bends;  // where along the path a variable meets its bound
    for (Index i = 0; i < x_.size(); ++i) {
      const double bound = gradient_[i] < 0 ? upper_[i] : lower_[i];
      const double time = gradient_[i] == 0 ? never : (x_[i] - bound) / gradient_[i];
      if (time <= 0)
        direction[i] = 0;
      else if (time < never)
        bends.emplace_back(time, i);
    }
    std::sort(bends.begin(), bends.end());
    CauchyPoint cauchy{x_, VectorXd::Zero(w.cols())};
    VectorXd p = w.transpose() * direction;
    double slope = -direction.squaredNorm();
    if (slope == 0) return cauchy;
    const auto timesM = [&](const VectorXd& v) -> VectorXd { return hessian_.empty() ? v : hessian_.timesM(v); };
    const double firstCurvature = -theta * slope - p.dot(timesM(p));
    double curvature = firstCurvature, least = -slope / curvature, from = 0;
    for (const auto& [time, i] : bends) {
      const double span = time - from;
      if (least < span) break;
      cauchy.x[i] = direction[i] > 0 ? upper_[i] : lower_[i];
      const double offset = cauchy.x[i] - x_[i], g = gradient_[i];
      cauchy.c += span * p;
      const VectorXd row = w.row(i);
      const VectorXd mRow = timesM(row);
      slope += span * curvature + g * g + theta * g * offset - g * mRow.dot(cauchy.c);
      curvature += -theta * g * g - 2 * g * mRow.dot(p) - g * g * mRow.dot(row);
      curvature = std::max(curvature, std::numeric_limits<double>::epsilon() * firstCurvature);
      p += g * row;
      direction[i] = 0;
      least = -slope / curvature;
      from = time;
    }
    least = std::max(least, 0.0);
    from += least;
    if (!std::isfinite(from)) from = 0;
    for (Index i = 0; i < x_.size(); ++i)
      if (direction[i] != 0) cauchy.x[i] = std::clamp(x_[i] + from * direction[i], lower_[i], upper_[i]);
    cauchy.c += least * p;
    return cauchy;
  }

  /// The minimum of the model over the variables that are between their bounds at the Cauchy point (5.1), projected
  /// onto the bounds, or cut at them where projecting it spoils the descent.
  VectorXd minimizeOverFree(const CauchyPoint& cauchy) const {
    if (hessian_.empty()) return cauchy.x;
    const double theta = hessian_.theta();
    std::vector<Index> free;
    for (Index i = 0; i < x_.size(); ++i)
      if (cauchy.x[i] > lower_[i] && cauchy.x[i] < upper_[i]) free.push_back(i);
    if (free.empty()) return cauchy.x;
    const Eigen::MatrixXd w = hessian_.w()(free, Eigen::all);
    const VectorXd reduced =
        (gradient_ + theta * (cauchy.x - x_))(free)-w * hessian_.timesM(cauchy.c);  // gradient of the model
    const Eigen::MatrixXd system =
        Eigen::MatrixXd::Identity(w.cols(), w.cols()) - hessian_.m() * (w.transpose() * w) / theta;
    const VectorXd v = system.partialPivLu().solve(hessian_.timesM(w.transpose() * reduced));
    const VectorXd change = -reduced / theta - w * v / (theta * theta);
    if (!change.allFinite()) return cauchy.x;
    VectorXd result = cauchy.x;
    result(free) += change;
    result = projected(result);
    if (gradient_.dot(result - x_) < 0) return result;
    double share = 1;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Index i = free[k], j = static_cast<Index>(k);
      if (change[j] > 0) share = std::min(share, (upper_[i] - cauchy.x[i]) / change[j]);
      if (change[j] < 0) share = std::min(share, (lower_[i] - cauchy.x[i]) / change[j]);
    }
    result = cauchy.x;
    result(free) += share * change;
    return projected(result);
  }

  BoundedObjective& objective_;
  VectorXd& x_;
  const VectorXd& lower_;
  const VectorXd& upper_;
  const BoundedQuasiNewtonOptions& options_;
  base::ExecutionContext& context_;
  const std::function<void(const BoundedIterate&)>& onIterate_;
  LimitedMemoryHessian hessian_;
  double value_ = 0;
  VectorXd gradient_;
  double foretold_ = 0;  ///< what the last step would change of f to first order
  int evaluations_ = 0;
  bool cancelled_ = false;
  base::SolverReport report_;
};

}  // namespace

base::SolverReport minimizeWithinBounds(BoundedObjective& objective, VectorXd& x, const VectorXd& lower,
                                        const VectorXd& upper, const BoundedQuasiNewtonOptions& options,
                                        base::ExecutionContext& context,
                                        const std::function<void(const BoundedIterate&)>& onIterate) {
  if (lower.size() != x.size() || upper.size() != x.size() || !(lower.array() <= upper.array()).all())
    throw std::invalid_argument("bounds that do not fit the variables or cross");
  return BoundedMinimization(objective, x, lower, upper, options, context, onIterate).run();
}

}  // namespace pliant::solvers
