#include "core/harmonic/method_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

namespace pliant::harmonic {

namespace {

using base::TerminationType;

void requireAscending(const std::vector<int>& numbers, const std::string& what) {
  if (numbers.empty()) throw base::InputError("", "a comparison needs at least one entry of " + what);
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (numbers[i] <= numbers[i - 1]) throw base::InputError("", "the " + what + " must ascend");
}

double meanDistance(const Matrix& one, const Matrix& other) { return (one - other).rowwise().norm().mean(); }

class Comparison {
 public:
  Comparison(std::shared_ptr<const Model> model, double omega, const MethodComparisonOptions& options,
             base::ExecutionContext& context)
      : model_(std::move(model)), omega_(omega), options_(options), context_(context), times_(options.steps.front()) {}

  MethodComparison run() {
    const base::Stopwatch watch;
    if (balance() && integrate()) {
      compare();
      balanceWithSamples();
    }
    if (context_.cancelRequested()) stop(TerminationType::cancelled, "The comparison was cancelled.");
    result_.report.seconds = watch.seconds();
    return std::move(result_);
  }

 private:
  Matrix positionsOf(const HarmonicBalanceProblem& problem, const Vector& z) const {
    Matrix positions(times_, model_->coordinateCount());
    for (int i = 0; i < times_; ++i)
      positions.row(i) = problem.configurationAt(z, 2 * std::numbers::pi * i / times_).transpose();
    return positions;
  }

  /// Solves with these numbers of harmonics and samples from the motion before; false if that fails.
  bool solve(int harmonics, int samples, bool sameSamples, Vector& start, int& startHarmonics) {
    const base::Stopwatch watch;
    HarmonicBalanceProblem problem(model_, {harmonics, samples});
    const Vector first =
        start.size() == 0 ? start : HarmonicBalanceProblem::changeHarmonics(start, startHarmonics, harmonics);
    PeriodicMotion motion = solvePeriodicMotion(problem, omega_, options_.newton, context_, first);
    ComparedSolution solution;
    solution.harmonics = harmonics;
    solution.samples = samples;
    solution.sameSamples = sameSamples;
    solution.termination = motion.report.termination;
    solution.seconds = watch.seconds();
    result_.solutions.push_back(solution);
    if (!motion.report.converged()) {
      positions_.emplace_back();
      stop(motion.report.termination, "Harmonic balance with " + std::to_string(harmonics) + " harmonics and " +
                                          std::to_string(samples) + " samples failed: " + motion.report.message);
      return false;
    }
    positions_.push_back(positionsOf(problem, motion.z));
    start = std::move(motion.z);
    startHarmonics = harmonics;
    return true;
  }

  /// Few harmonics may have no motion at all, where a foil cannot bend with them unstretched; the most must have one.
  bool balance() {
    bool solved = false;
    for (const int harmonics : options_.harmonics) {
      solved = solve(harmonics, std::max(options_.samples, 4 * harmonics + 1), false, finest_, finestHarmonics_);
      if (context_.cancelRequested()) return false;
    }
    return solved;
  }

  bool integrate() {
    const HarmonicBalanceProblem problem(model_, {finestHarmonics_, 4 * finestHarmonics_ + 1});
    for (std::size_t i = 0; i < options_.steps.size(); ++i) {
      const base::Stopwatch watch;
      TimeIntegrationOptions integration = options_.integration;
      integration.stepsPerPeriod = options_.steps[i];
      const TimeIntegration found = integrateToPeriodicity(problem, omega_, integration, context_, finest_);
      ComparedSolution solution;
      solution.samples = options_.steps[i];
      solution.periods = static_cast<int>(found.periods.size());
      solution.termination = found.report.termination;
      solution.seconds = watch.seconds();
      result_.solutions.push_back(solution);
      if (!found.report.converged()) {
        stop(found.report.termination,
             "With " + std::to_string(options_.steps[i]) + " steps a period: " + found.report.message);
        return false;
      }
      const int stride = options_.steps[i] / times_;
      newmark_.push_back(found.positions(Eigen::seqN(0, times_, stride), Eigen::all));
      positions_.push_back(newmark_.back());
    }
    return true;
  }

  void compare() {
    reference_ = newmark_.back();
    if (const std::size_t n = newmark_.size(); n > 1) {
      const double ratio = static_cast<double>(options_.steps[n - 1]) / options_.steps[n - 2];
      reference_ += (newmark_[n - 1] - newmark_[n - 2]) / (ratio * ratio - 1);
    }
    const Eigen::RowVectorXd mean = reference_.colwise().mean();
    result_.swing = std::sqrt((reference_.rowwise() - mean).squaredNorm() / times_);
    for (std::size_t i = 0; i < result_.solutions.size(); ++i) {
      if (positions_[i].size() == 0) continue;
      result_.solutions[i].toNewmark = meanDistance(positions_[i], newmark_.back());
      result_.solutions[i].toReference = meanDistance(positions_[i], reference_);
    }
    result_.report.termination = TerminationType::converged;
  }

  void balanceWithSamples() {
    Vector start = finest_;
    int startHarmonics = finestHarmonics_;
    const int harmonics = options_.samplesHarmonics;
    for (std::size_t i = 0; i < options_.steps.size(); ++i) {
      const int samples = options_.steps[i];
      if (samples < 2 * harmonics + 1 || samples > options_.maximumSamples) continue;
      if (!solve(harmonics, samples, true, start, startHarmonics)) return;
      ComparedSolution& solution = result_.solutions.back();
      solution.toNewmark = meanDistance(positions_.back(), newmark_[i]);
      solution.toReference = meanDistance(positions_.back(), reference_);
    }
  }

  void stop(TerminationType termination, std::string message) {
    result_.report.termination = termination;
    result_.report.message = std::move(message);
  }

  std::shared_ptr<const Model> model_;
  double omega_;
  const MethodComparisonOptions& options_;
  base::ExecutionContext& context_;
  int times_;
  Vector finest_;
  int finestHarmonics_ = 0;
  std::vector<Matrix> positions_;  ///< of result_.solutions at the common times
  std::vector<Matrix> newmark_;
  Matrix reference_;
  MethodComparison result_;
};

}  // namespace

MethodComparison compareMethods(std::shared_ptr<const Model> model, double omega,
                                const MethodComparisonOptions& options, base::ExecutionContext& context) {
  requireAscending(options.harmonics, "numbers of harmonics");
  requireAscending(options.steps, "numbers of steps a period");
  for (const int steps : options.steps)
    if (steps % options.steps.front() != 0)
      throw base::InputError(
          "", "the numbers of steps a period must be multiples of the first, " + std::to_string(options.steps.front()));
  return Comparison(std::move(model), omega, options, context).run();
}

}  // namespace pliant::harmonic
