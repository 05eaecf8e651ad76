#include "core/scene/cloth_recording.hpp"

namespace pliant::scene {

using base::TerminationType;

namespace {

/// Between two snapshots for whoever watches [s].
constexpr double observationInterval = 0.05;

}  // namespace

std::shared_ptr<const ClothFrame> makeClothFrame(const cloth::ClothProblem& problem, double time,
                                                 const Eigen::Matrix3Xd& positions, double bodiesAt,
                                                 const solvers::ConeSolution* solution) {
  const cloth::LimitedSheet& sheet = problem.sheet;
  auto frame = std::make_shared<ClothFrame>();
  frame->time = time;
  frame->positions = positions;
  frame->bodyPoints = cloth::bodyPointsAt(problem, bodiesAt);
  frame->stretchRatios = cloth::stretchRatios(sheet, positions);
  frame->limitForces.setZero(static_cast<Eigen::Index>(sheet.triangles.size()));
  Eigen::Index element = 0;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
    if (sheet.triangles[t].limit >= 0 && solution && element < solution->multipliers.cols()) {
      frame->limitForces[static_cast<Eigen::Index>(t)] = solution->multipliers.col(element).head<2>().sum();
      ++element;
    }
  return frame;
}

ClothRecording::ClothRecording(std::shared_ptr<const cloth::ClothProblem> problem, Provenance provenance,
                               const ResultObserver& observe)
    : observe_(observe) {
  result_->problem = std::move(problem);
  result_->provenance = std::move(provenance);
}

void ClothRecording::addFrame(double time, const Eigen::Matrix3Xd& positions, double bodiesAt,
                              const solvers::ConeSolution* solution) {
  addFrame(makeClothFrame(*result_->problem, time, positions, bodiesAt, solution));
}

void ClothRecording::addStep(const cloth::StepRecord& step, double time, double residual) {
  ClothStepRecord record;
  record.time = time;
  record.energies = step.energies;
  record.violation = step.violation;
  record.relativeGap = step.projection ? step.projection->relativeGap() : 0;
  record.residual = residual;
  record.newtonIterations = step.newtonIterations;
  record.projectionIterations = step.projectionIterations;
  record.newtonSeconds = step.newtonSeconds;
  record.projectionSeconds = step.projectionSeconds;
  record.smallestGap = step.smallestGap;
  record.converged = step.termination == TerminationType::converged;
  result_->steps.push_back(record);
  if (step.projection) {
    result_->lastProjection = step.projection->report;
    result_->projection = step.projection;
  }
}

void ClothRecording::observe() {
  if (!observe_ || sinceObserved_.seconds() < observationInterval) return;
  result_->seconds = watch_.seconds();
  observe_(std::make_shared<const ClothResult>(*result_));
  sinceObserved_ = base::Stopwatch();
}

std::shared_ptr<const ClothResult> ClothRecording::finish(TerminationType termination, const std::string& message) {
  result_->termination = termination;
  result_->message = message;
  result_->seconds = watch_.seconds();
  if (observe_) observe_(result_);
  return result_;
}

}  // namespace pliant::scene
