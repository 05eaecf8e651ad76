#include "core/solvers/bounded_least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/base/stopwatch.hpp"

namespace pliant::solvers {

namespace {

using base::TerminationType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class LeastSquaresFit {
 public:
  LeastSquaresFit(ResidualFunction& function, VectorXd& x, const VectorXd& lower, const VectorXd& upper,
                  const BoundedLeastSquaresOptions& options, base::ExecutionContext& context,
                  const std::function<void(const LeastSquaresIterate&)>& onIterate)
      : function_(function),
        x_(x),
        lower_(lower),
        upper_(upper),
        options_(options),
        context_(context),
        onIterate_(onIterate),
        damping_(options.firstDamping) {}

  base::SolverReport run() {
    const base::Stopwatch watch;
    x_ = x_.cwiseMax(lower_).cwiseMin(upper_);
    if (evaluate(x_, residuals_) && linearize())
      iterate();
    else
      finish(cancelled_ ? TerminationType::cancelled : TerminationType::failed,
             "There are no residuals at the starting point.");
    report_.seconds = watch.seconds();
    return report_;
  }

 private:
  void finish(TerminationType termination, const char* message = "") {
    report_.termination = termination;
    report_.message = message;
  }

  bool evaluate(const VectorXd& x, VectorXd& residuals) {
    if (context_.cancelRequested()) {
      cancelled_ = true;
      return false;
    }
    ++evaluations_;
    return function_.evaluate(x, residuals, nullptr) && residuals.allFinite();
  }

  /// The Jacobian at x_, and the scales of its columns.
  bool linearize() {
    VectorXd again;
    if (!function_.evaluate(x_, again, &jacobian_) || !jacobian_.allFinite()) return false;
    const VectorXd lengths = jacobian_.colwise().norm().transpose();
    scales_ = scales_.size() == 0 ? lengths : VectorXd(scales_.cwiseMax(lengths));
    return true;
  }

  double largestCosine() const {
    const double norm = residuals_.norm();
    double largest = 0;
    for (Index i = 0; i < x_.size(); ++i) {
      const double slope = jacobian_.col(i).dot(residuals_), length = jacobian_.col(i).norm();
      if (length == 0 || norm == 0 || (slope > 0 ? x_[i] <= lower_[i] : x_[i] >= upper_[i])) continue;
      largest = std::max(largest, std::abs(slope) / (length * norm));
    }
    return largest;
  }

  void record(int iteration, double decrease) {
    const double cosine = largestCosine();
    report_.iterations.push_back({iteration, cosine, iteration == 0 ? 0.0 : 1.0, decrease});
    if (onIterate_) onIterate_({iteration, x_, residuals_, jacobian_, cosine, damping_, evaluations_});
    context_.reportProgress(static_cast<double>(iteration) / options_.maximumIterations);
  }

  void iterate() {
    record(0, 0);
    for (int iteration = 1;; ++iteration) {
      if (residuals_.squaredNorm() == 0 || largestCosine() <= options_.gradientTolerance)
        return finish(TerminationType::converged);
      if (iteration > options_.maximumIterations)
        return finish(TerminationType::iterationLimit, "The iteration limit was reached before a minimum.");
      const double before = residuals_.squaredNorm();
      const Outcome outcome = step();
      if (outcome == Outcome::cancelled) return finish(TerminationType::cancelled, "The fit was cancelled.");
      if (outcome == Outcome::noneLeft) return finish(TerminationType::converged);
      if (outcome == Outcome::noneFound)
        return finish(TerminationType::failed, "No step found a lower sum of squares, however short.");
      record(iteration, (before - residuals_.squaredNorm()) / before);
    }
  }

  enum class Outcome { accepted, noneLeft, noneFound, cancelled };

  Outcome step() {
    constexpr int mostTrials = 40;
    const double before = residuals_.squaredNorm();
    bool evaluated = false;  // a trial point whose residuals were found
    for (int trial = 0; trial < mostTrials; ++trial) {
      const VectorXd change = dampedStep();
      const double foretold = before - (residuals_ + jacobian_ * change).squaredNorm();
      const bool tiny =
          foretold <= options_.valueTolerance * before || change.cwiseAbs().maxCoeff() <= options_.stepTolerance;
      if (tiny && (evaluated || trial == 0)) return Outcome::noneLeft;
      if (tiny) return Outcome::noneFound;
      const VectorXd next = (x_ + change).cwiseMax(lower_).cwiseMin(upper_);
      VectorXd residuals;
      const bool found = evaluate(next, residuals);
      if (cancelled_) return Outcome::cancelled;
      evaluated |= found;
      const double ratio = found ? (before - residuals.squaredNorm()) / foretold : -1;
      if (ratio > 1e-4) {
        const VectorXd previous = x_, previousResiduals = residuals_;
        const MatrixXd previousJacobian = jacobian_;
        x_ = next;
        residuals_ = residuals;
        if (linearize()) {
          damping_ *= std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3));
          growth_ = 2;
          return Outcome::accepted;
        }
        x_ = previous;
        residuals_ = previousResiduals;
        jacobian_ = previousJacobian;
      }
      damping_ = std::max(damping_, 1e-12) * growth_;
      growth_ *= 2;
    }
    return Outcome::noneFound;
  }

  VectorXd dampedStep() const {
    const Index count = x_.size();
    // Columns that do nothing would leave the system singular.
    const VectorXd scales = scales_.cwiseMax(std::max(1e-8 * scales_.maxCoeff(), std::numeric_limits<double>::min()));
    MatrixXd system(jacobian_.rows() + count, count);
    system << jacobian_, MatrixXd((std::sqrt(damping_) * scales).asDiagonal());
    VectorXd right = VectorXd::Zero(system.rows());
    right.head(residuals_.size()) = -residuals_;
    // Everything else needs the triangle alone.
    const Eigen::HouseholderQR<MatrixXd> factors(system);
    const MatrixXd triangle = factors.matrixQR().topRows(count).triangularView<Eigen::Upper>();
    right.applyOnTheLeft(factors.householderQ().adjoint());
    const double most = options_.maximumStep;
    return leastSquaresWithinBounds(
        triangle, right.head(count), (lower_ - x_).cwiseMax(-most), (upper_ - x_).cwiseMin(most));
  }

  ResidualFunction& function_;
  VectorXd& x_;
  const VectorXd& lower_;
  const VectorXd& upper_;
  const BoundedLeastSquaresOptions& options_;
  base::ExecutionContext& context_;
  const std::function<void(const LeastSquaresIterate&)>& onIterate_;
  double damping_, growth_ = 2;
  VectorXd residuals_, scales_;
  MatrixXd jacobian_;
  int evaluations_ = 0;
  bool cancelled_ = false;
  base::SolverReport report_;
};

}  // namespace

base::SolverReport fitWithinBounds(ResidualFunction& function, VectorXd& x, const VectorXd& lower,
                                   const VectorXd& upper, const BoundedLeastSquaresOptions& options,
                                   base::ExecutionContext& context,
                                   const std::function<void(const LeastSquaresIterate&)>& onIterate) {
  if (lower.size() != x.size() || upper.size() != x.size() || !(lower.array() <= upper.array()).all())
    throw std::invalid_argument("bounds that do not fit the variables or cross");
  return LeastSquaresFit(function, x, lower, upper, options, context, onIterate).run();
}

VectorXd leastSquaresWithinBounds(const MatrixXd& a, const VectorXd& b, const VectorXd& lower, const VectorXd& upper) {
  const Index count = a.cols();
  VectorXd x = VectorXd::Zero(count);
  VectorXd pull = a.transpose() * b;  // minus the gradient
  std::vector<char> held(static_cast<std::size_t>(count), 0);
  const auto isHeld = [&](Index i) -> char& { return held[static_cast<std::size_t>(i)]; };
  for (Index i = 0; i < count; ++i) isHeld(i) = pull[i] > 0 ? upper[i] <= 0 : lower[i] >= 0;
  for (Index round = 0; round < 20 * (count + 1); ++round) {
    std::vector<Index> free;
    for (Index i = 0; i < count; ++i)
      if (!isHeld(i)) free.push_back(i);
    double share = 1;
    if (!free.empty()) {
      VectorXd rest = x;
      rest(free).setZero();
      const MatrixXd columns = a(Eigen::all, free);
      const VectorXd change = columns.householderQr().solve(b - a * rest) - x(free);
      for (std::size_t k = 0; k < free.size(); ++k) {
        const Index i = free[k];
        const double d = change[static_cast<Index>(k)];
        if (x[i] + d > upper[i]) share = std::min(share, (upper[i] - x[i]) / d);
        if (x[i] + d < lower[i]) share = std::min(share, (lower[i] - x[i]) / d);
      }
      for (std::size_t k = 0; k < free.size(); ++k) {
        const Index i = free[k];
        const double target = x[i] + change[static_cast<Index>(k)], bound = target > upper[i] ? upper[i] : lower[i];
        const bool outside = target > upper[i] || target < lower[i];
        x[i] = std::clamp(x[i] + share * change[static_cast<Index>(k)], lower[i], upper[i]);
        if (outside && (bound - x[i] == 0 || std::abs(bound - x[i]) <= 1e-14 * std::abs(target))) {
          x[i] = bound;
          isHeld(i) = 1;
        }
      }
    }
    if (share < 1) continue;
    pull = a.transpose() * (b - a * x);
    const double least = 1e-13 * a.norm() * b.norm();
    Index freed = -1;
    for (Index i = 0; i < count; ++i) {
      if (!isHeld(i) || upper[i] <= lower[i]) continue;
      const double inwards = x[i] >= upper[i] ? -pull[i] : pull[i];
      if (inwards > least && (freed < 0 || inwards > std::abs(pull[freed]))) freed = i;
    }
    if (freed < 0) break;
    isHeld(freed) = 0;
  }
  return x;
}

}  // namespace pliant::solvers
