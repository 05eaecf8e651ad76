#include "tests/benchmarks/projection_contest.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_elements.hpp"

namespace pliant::bench {

namespace {

/// Cancels a computation that takes longer than it may.
class Deadline {
 public:
  Deadline(base::ExecutionContext& context, double seconds)
      : thread_([&context, seconds, this](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          condition_.wait_for(
              lock, stop, std::chrono::duration<double>(seconds), [&stop] { return stop.stop_requested(); });
          if (!stop.stop_requested()) context.requestCancel();
        }) {}

 private:
  std::mutex mutex_;
  std::condition_variable_any condition_;
  std::jthread thread_;
};

class ContestLimiter final : public cloth::StrainLimiter {
 public:
  ContestLimiter(const cloth::SheetCones& cones, const cloth::LimitedSheet& sheet,
                 const cloth::ProjectionOptions& options, int skipped, const std::vector<Contender>& contenders,
                 std::vector<ContestResult>& results)
      : sheet_(sheet), skipped_(skipped), contenders_(contenders), results_(results) {
    for (const Contender& contender : contenders) {
      solvers::ConeConstraints constraints = cones.constraints;
      if (contender.directions > 0) {
        solvers::MetricBounds& bounds = constraints.bounds.at(0);
        bounds = {};
        for (const auto& [angle, stretch] :
             cloth::directionConstraints(sheet.limits.at(0), contender.directions).directions)
          bounds.directions.emplace_back(std::cos(angle) / stretch, std::sin(angle) / stretch);
      }
      cloth::ProjectionOptions own = options;
      own.cone.warmStart = contender.warmStart;
      limiters_.push_back(cloth::makeStrainLimiter(contender.method, constraints, own));
    }
  }

  std::string_view name() const override { return "contest"; }

  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                base::ExecutionContext& context) override {
    const int turn = count_++ - skipped_;
    for (std::size_t i = 1; turn >= 0 && i < contenders_.size(); ++i)
      if (turn % contenders_[i].every == 0 && results_[i].projections < contenders_[i].most) {
        base::ExecutionContext own;
        const Deadline deadline(own, contenders_[i].budget);
        record(i, limiters_[i]->project(candidate, start, own));
      }
    solvers::ConeSolution solution = limiters_[0]->project(candidate, start, context);
    if (turn >= 0) record(0, solution);
    return solution;
  }

 private:
  void record(std::size_t i, const solvers::ConeSolution& solution) {
    ContestResult& result = results_[i];
    const auto& iterations = solution.report.iterations;
    ++result.projections;
    result.converged += solution.report.converged();
    result.seconds += solution.report.seconds;
    result.iterations += iterations.empty() ? 0 : iterations.back().iteration;
    result.overshoot = std::max(result.overshoot, cloth::stretchRatios(sheet_, solution.positions).maxCoeff() - 1);
  }

  const cloth::LimitedSheet& sheet_;
  int skipped_;
  int count_ = 0;
  const std::vector<Contender>& contenders_;
  std::vector<ContestResult>& results_;
  std::vector<std::unique_ptr<cloth::StrainLimiter>> limiters_;
};

}  // namespace

std::vector<ContestResult> runContest(const cloth::ClothProblem& problem, const cloth::SteppingOptions& options,
                                      int steps, int skipped, const std::vector<Contender>& contenders) {
  std::vector<ContestResult> results(contenders.size());
  cloth::ClothSimulation simulation(
      std::make_shared<const cloth::ClothProblem>(problem), options, [&](const cloth::SheetCones& cones) {
        return std::make_unique<ContestLimiter>(cones, problem.sheet, options.projection, skipped, contenders, results);
      });
  base::ExecutionContext context;
  for (int step = 0; step < steps; ++step) {
    const cloth::StepRecord record = simulation.step(context);
    if (record.termination != base::TerminationType::converged)
      throw std::runtime_error("step " + std::to_string(step) + ": " + record.message);
  }
  for (ContestResult& result : results) {
    result.seconds /= std::max(1, result.projections);
    result.iterations /= std::max(1, result.projections);
  }
  return results;
}

double unavoidableSeconds(const cloth::ClothProblem& problem) {
  cloth::LimitedSheet sheet = problem.sheet;
  sheet.fixed = cloth::heldNodes(problem, 0);
  const solvers::ConeConstraints constraints = cloth::sheetCones(sheet, cloth::ProjectionNorm::mass).constraints;
  std::vector<int> vertices(static_cast<std::size_t>(constraints.nodeCount), -1);
  int count = 0;
  for (std::size_t node = 0; node < vertices.size(); ++node)
    if (!constraints.fixed[node]) vertices[node] = count++;
  std::vector<std::array<int, 2>> pairs;
  for (const solvers::ConeElement& element : constraints.elements)
    for (int a = 0; a < 3; ++a)
      if (const std::array<int, 2> pair{vertices[element.nodes[a]], vertices[element.nodes[(a + 1) % 3]]};
          pair[0] >= 0 && pair[1] >= 0)
        pairs.push_back(pair);
  math::BlockCholesky cholesky(count, pairs);
  solvers::ConeElements elements(constraints, vertices, cholesky);
  const solvers::Positions x = problem.model->restPositions.reshaped(3, constraints.nodeCount);
  elements.start(x, 1, false);
  solvers::Positions forces = solvers::Positions::Zero(3, x.cols()), predictorForces = forces;
  Eigen::VectorXd unknowns = Eigen::VectorXd::Ones(3 * Eigen::Index{count});
  std::vector<double> seconds;
  for (int repetition = 0; repetition < 7; ++repetition) {
    const base::Stopwatch watch;
    cholesky.clear();
    elements.linearize(x, forces, predictorForces, cholesky);
    if (!cholesky.factorize()) throw std::runtime_error("the linear system of a projection is singular");
    cholesky.solve(unknowns);
    seconds.push_back(watch.seconds());
  }
  std::nth_element(seconds.begin(), seconds.begin() + 3, seconds.end());
  return seconds[3];
}

}  // namespace pliant::bench
