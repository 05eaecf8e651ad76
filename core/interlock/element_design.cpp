#include "core/interlock/element_design.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/interlock/element_evaluation.hpp"
#include "core/solvers/quadratic_program.hpp"

namespace pliant::interlock {

namespace {

using base::TerminationType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A gap that is short of the clearance by this part of it counts as wide enough.
constexpr double clearanceTolerance = 1e-9;
/// Steps aim for this much more, relative.
constexpr double aimedExcess = 1e-6;
/// Of the largest curvature: keeps numbers that no limit depends on where they are.
constexpr double smallestCurvature = 1e-6;
/// A step is taken if it brings this part of what the linear model promises.
constexpr double smallestGain = 1e-3;
constexpr double stationaryGain = 1e-7;
constexpr int restorations = 12;
/// Tries to find which limits count after a step.
constexpr int limitChoices = 16;

class DesignSearch {
 public:
  DesignSearch(const ElementDesignProblem& problem, const ElementDesignOptions& options,
               base::ExecutionContext& context)
      : problem_(problem), options_(options), context_(context), range_(problem.upper - problem.lower) {
    for (const LimitGoal& goal : problem.goals) weights_ += goal.weight;
  }

  ElementDesignResult run(const std::function<void(const ElementDesignResult&)>& observe) {
    VectorXd values = problem_.start.cwiseMax(problem_.lower).cwiseMin(problem_.upper);
    ElementEvaluation here = evaluate(values);
    if (!here.valid) return finish(failed(here.problem));
    double trust = options_.firstStep;
    add(values, here, 0, 0);
    if (observe) observe(result_);
    for (int iteration = 1;; ++iteration) {
      if (result_.best().residual <= options_.tolerance && shortage(here) == 0) return finish(DesignEnd::reached);
      if (iteration > options_.maximumIterations) {
        result_.termination = TerminationType::iterationLimit;
        result_.message =
            "the limits wanted were not reached in " + std::to_string(options_.maximumIterations) + " iterations";
        return finish(DesignEnd::other);
      }
      bool better = false;
      while (!better) {
        const VectorXd residuals = residualsOf(here);
        const VectorXd step = stepFrom(values, here, residuals, trust);
        const VectorXd trial = restored(values + range_.cwiseProduct(step));
        const VectorXd taken = scaled(trial - values);
        const double size = taken.cwiseAbs().maxCoeff();
        const double before = residuals.squaredNorm(), promised = before - predicted(here, residuals, taken);
        const double relative = promiseOf(values, here, residuals) / std::max(before, 1e-300);
        result_.history.back().stationarity = relative;
        if (shortage(here) == 0 && relative < stationaryGain) return finish(DesignEnd::stationary);
        if (trust < options_.smallestStep) return finish(DesignEnd::kink);
        ElementEvaluation next = evaluate(trial);
        if (context_.cancelRequested()) {
          result_.termination = TerminationType::cancelled;
          result_.message = "cancelled";
          return finish(DesignEnd::other);
        }
        if (!next.valid) {
          ++result_.failures;
          trust = 0.25 * std::min(trust, std::max(size, options_.smallestStep));
          continue;
        }
        const VectorXd nextResiduals = residualsOf(next);
        const double gain = before - nextResiduals.squaredNorm();
        const bool nearer = shortage(here) > 0 && shortage(next) < 0.9 * shortage(here);
        better = nearer || (shortage(next) <= shortage(here) && gain > smallestGain * promised && gain > 0);
        if (!better)
          trust = std::min(0.5 * trust, 0.5 * std::max(size, options_.smallestStep));
        else if (!nearer && gain < 0.25 * promised)
          trust *= 0.5;
        else if (gain > 0.75 * promised && size > 0.9 * trust)
          trust = std::min(2 * trust, options_.largestStep);
        if (!better) continue;
        values = trial;
        here = std::move(next);
        add(values, here, iteration, size);
      }
      context_.reportProgress(iteration / static_cast<double>(options_.maximumIterations));
      if (observe) observe(result_);
    }
  }

 private:
  ElementEvaluation evaluate(const VectorXd& values) {
    ++result_.evaluations;
    return evaluateElement(problem_, values, barriers_, context_);
  }

  /// Weighted differences to the limits wanted.
  VectorXd residualsOf(const ElementEvaluation& at) const {
    VectorXd residuals(at.limits.size());
    for (Index i = 0; i < residuals.size(); ++i) residuals[i] = residualOf(i, at.limits[i]);
    return residuals;
  }
  double residualOf(Index goal, double limit) const {
    const LimitGoal& own = problem_.goals[static_cast<std::size_t>(goal)];
    const double difference = limit - own.wanted;
    if (own.kind == LimitGoal::Kind::atLeast && difference > 0) return 0;
    return std::sqrt(own.weight) * difference;
  }

  /// How much the clearance is missed by [m].
  double shortage(const ElementEvaluation& at) const {
    const double missing = problem_.clearance - at.clearance;
    return missing > clearanceTolerance * problem_.clearance ? missing : 0;
  }

  VectorXd scaled(const VectorXd& change) const {
    VectorXd result = change;
    for (Index i = 0; i < result.size(); ++i) result[i] = range_[i] > 0 ? change[i] / range_[i] : 0;
    return result;
  }

  /// What the linear model promises of a step as long as the first may be.
  double promiseOf(const VectorXd& values, const ElementEvaluation& at, const VectorXd& residuals) const {
    const VectorXd step = stepFrom(values, at, residuals, options_.firstStep);
    return std::max(0.0, residuals.squaredNorm() - predicted(at, residuals, step));
  }

  double predicted(const ElementEvaluation& at, const VectorXd& residuals, const VectorXd& step) const {
    double sum = 0;
    const VectorXd limits = at.limits + at.slopes * range_.cwiseProduct(step);
    for (Index i = 0; i < residuals.size(); ++i)
      sum += std::isfinite(at.limits[i]) ? std::pow(residualOf(i, limits[i]), 2) : 0;
    return sum;
  }

  /// The constraints A x <= b of a step x, over the numbers' ranges, and one more unknown that makes up for gaps which
  /// no such step makes wide enough: within `reach`, the bounds, and with the linearised gaps.
  void addConstraints(const VectorXd& values, const ElementEvaluation& at, double reach, MatrixXd& matrix,
                      VectorXd& bounds) const {
    const Index count = values.size(), gaps = at.gaps.size();
    matrix.setZero(2 * count + 1 + gaps, count + 1);
    bounds.resize(matrix.rows());
    for (Index i = 0; i < count; ++i) {
      const bool locked = !(range_[i] > 0);
      matrix(2 * i, i) = 1;
      matrix(2 * i + 1, i) = -1;
      // Locked numbers have a little room, which nothing uses, so that the program has an inside.
      bounds[2 * i] = locked ? 1e-9 : std::min(reach, (problem_.upper[i] - values[i]) / range_[i]);
      bounds[2 * i + 1] = locked ? 1e-9 : std::min(reach, (values[i] - problem_.lower[i]) / range_[i]);
    }
    matrix(2 * count, count) = -1;
    bounds[2 * count] = 0;
    const double unit = problem_.clearance > 0 ? problem_.clearance : 1;
    for (Index k = 0; k < gaps; ++k) {
      const Index row = 2 * count + 1 + k;
      matrix.row(row).head(count) = -(at.gapSlopes.row(k).array() * range_.transpose().array()) / unit;
      matrix(row, count) = -1;
      bounds[row] = (at.gaps[k] - problem_.clearance * (1 + aimedExcess)) / unit;
    }
  }

  VectorXd solved(const VectorXd& values, const ElementEvaluation& at, double reach, MatrixXd curvature,
                  const VectorXd& slope, double penalty) const {
    const Index count = values.size();
    MatrixXd matrix, hessian = MatrixXd::Zero(count + 1, count + 1);
    VectorXd bounds, gradient(count + 1);
    addConstraints(values, at, reach, matrix, bounds);
    hessian.topLeftCorner(count, count) = curvature;
    hessian(count, count) = curvature.diagonal().maxCoeff();
    gradient << slope, penalty;
    VectorXd step = solvers::solveQuadraticProgram(hessian, gradient, matrix, bounds).x.head(count);
    for (Index i = 0; i < count; ++i)
      step[i] = range_[i] > 0 && std::isfinite(step[i]) ? std::clamp(step[i], -bounds[2 * i + 1], bounds[2 * i]) : 0;
    return step;
  }

  /// The step of the Gauss-Newton method, over the numbers' ranges. Limits that only must not be nearer count where
  /// they are nearer after the step, which is found by trying.
  VectorXd stepFrom(const VectorXd& values, const ElementEvaluation& at, const VectorXd& residuals,
                    double trust) const {
    const auto isNearer = [&](const VectorXd& limits) {
      std::vector<bool> nearer;
      for (Index i = 0; i < limits.size(); ++i) nearer.push_back(residualOf(i, limits[i]) != 0);
      return nearer;
    };
    std::vector<bool> counts = isNearer(at.limits);
    VectorXd best = VectorXd::Zero(values.size());
    double least = residuals.squaredNorm();
    for (int attempt = 0; attempt < limitChoices; ++attempt) {
      const VectorXd step = stepWith(values, at, counts, trust);
      const double sum = predicted(at, residuals, step);
      if (sum < least) least = sum, best = step;
      std::vector<bool> next = isNearer(at.limits + at.slopes * range_.cwiseProduct(step));
      // Choices could go round; those that only grow cannot.
      for (std::size_t i = 0; attempt >= limitChoices / 2 && i < next.size(); ++i) next[i] = next[i] || counts[i];
      if (next == counts) return shortage(at) > 0 ? step : best;
      counts = std::move(next);
    }
    return best;
  }

  VectorXd stepWith(const VectorXd& values, const ElementEvaluation& at, const std::vector<bool>& counts,
                    double trust) const {
    MatrixXd jacobian = at.slopes * range_.asDiagonal();
    VectorXd differences = VectorXd::Zero(jacobian.rows());
    for (Index i = 0; i < jacobian.rows(); ++i) {
      const LimitGoal& goal = problem_.goals[static_cast<std::size_t>(i)];
      const double root = counts[static_cast<std::size_t>(i)] ? std::sqrt(goal.weight) : 0;
      jacobian.row(i) *= root;
      if (root > 0) differences[i] = root * (at.limits[i] - goal.wanted);
    }
    MatrixXd hessian = jacobian.transpose() * jacobian;
    const double largest = std::max(hessian.diagonal().maxCoeff(), 1e-12);
    hessian.diagonal().array() += smallestCurvature * largest;
    const VectorXd slope = jacobian.transpose() * differences;
    // More than any gain in the limits is worth.
    const double penalty = 10 * (slope.cwiseAbs().sum() + largest);
    return solved(values, at, trust, hessian, slope, penalty);
  }

  /// The nearest numbers whose gaps at rest are wide enough, by linearising these again and again.
  VectorXd restored(VectorXd values) const {
    values = values.cwiseMax(problem_.lower).cwiseMin(problem_.upper);
    if (!(problem_.clearance > 0)) return values;
    const Index count = values.size();
    for (int i = 0; i < restorations; ++i) {
      const ElementEvaluation rest = evaluateRest(problem_, values);
      if (!rest.valid || shortage(rest) == 0) break;
      const VectorXd step = solved(values, rest, 1, MatrixXd::Identity(count, count), VectorXd::Zero(count), 1e3);
      values = (values + range_.cwiseProduct(step)).cwiseMax(problem_.lower).cwiseMin(problem_.upper);
    }
    return values;
  }

  void add(const VectorXd& values, const ElementEvaluation& at, int iteration, double size) {
    ElementIterate iterate;
    iterate.iteration = iteration;
    iterate.values = values;
    iterate.limits = at.limits;
    iterate.residual = std::sqrt(residualsOf(at).squaredNorm() / std::max(weights_, 1e-300));
    iterate.clearance = at.clearance;
    iterate.stepSize = size;
    iterate.evaluations = result_.evaluations;
    iterate.failures = result_.failures;
    iterate.kinks = at.kinks;
    result_.history.push_back(std::move(iterate));
  }

  DesignEnd failed(const std::string& problem) {
    const bool cancelled = context_.cancelRequested();
    result_.termination = cancelled ? TerminationType::cancelled : TerminationType::failed;
    result_.message = cancelled ? "cancelled" : "the element to start from is none that can be designed: " + problem;
    return DesignEnd::other;
  }

  ElementDesignResult finish(DesignEnd end) {
    result_.end = end;
    if (end != DesignEnd::other) result_.termination = TerminationType::converged;
    return result_;
  }

  const ElementDesignProblem& problem_;
  const ElementDesignOptions& options_;
  base::ExecutionContext& context_;
  const VectorXd range_;
  double weights_ = 0;
  std::vector<CellContact::Barrier> barriers_;
  ElementDesignResult result_;
};

}  // namespace

ElementDesignResult designElement(const ElementDesignProblem& problem, const ElementDesignOptions& options,
                                  base::ExecutionContext& context,
                                  const std::function<void(const ElementDesignResult&)>& observe) {
  return DesignSearch(problem, options, context).run(observe);
}

}  // namespace pliant::interlock
