#include "core/cloth/step_attempt.hpp"

namespace pliant::cloth {

using base::TerminationType;

namespace {

Eigen::Matrix3Xd asPoints(const Vector& coordinates) { return coordinates.reshaped(3, coordinates.size() / 3); }

}  // namespace

ClothSimulation::Attempt::Attempt(ClothSimulation& owner, base::ExecutionContext& executionContext)
    : simulation(owner),
      context(executionContext),
      x(owner.state_.positions.reshaped()),
      v(owner.state_.velocities.reshaped()) {
  next.time = owner.state_.time + owner.options_.timeStep;
  owner.potential_.beginWind(owner.state_.positions, owner.state_.time);
}

bool ClothSimulation::Attempt::advance(StepTerms terms, const Vector& from, double fraction, Vector& candidate) {
  IncrementalPotential& potential = simulation.potential_;
  Vector inertial = simulation.withPins(terms.target, fraction);
  candidate = simulation.withPins(from, fraction);
  potential.setTerms(std::move(terms));
  if (potential.value(inertial) < potential.value(candidate)) candidate = std::move(inertial);
  const base::SolverReport report = potential.minimize(candidate, simulation.options_.newton, context);
  record.newtonIterations += static_cast<int>(report.iterations.size()) - (report.iterations.empty() ? 0 : 1);
  record.newtonSeconds += report.seconds;
  if (!report.converged()) {
    record.termination = report.termination;
    record.message = report.message;
  }
  return report.converged() || report.termination == TerminationType::iterationLimit;
}

bool ClothSimulation::Attempt::project(Vector& candidate, double fraction) {
  if (!simulation.limiter_ && !simulation.contactProjection_) return true;
  const base::Stopwatch watch;
  const Eigen::Matrix3Xd& start = record.projection ? record.projection->positions : simulation.state_.positions;
  auto solution = std::make_shared<solvers::ConeSolution>(
      simulation.contactProjection_ ? projectWithContact(asPoints(candidate), start, fraction)
                                    : simulation.limiter_->project(asPoints(candidate), start, context));
  ++record.projections;
  record.projectionIterations += static_cast<int>(solution->report.iterations.size());
  record.projectionSeconds += watch.seconds();
  const TerminationType termination = solution->report.termination;
  if (termination != TerminationType::converged) {
    record.termination = termination;
    record.message = solution->report.message;
  }
  candidate = solution->positions.reshaped();
  record.projection = std::move(solution);
  return termination == TerminationType::converged || termination == TerminationType::iterationLimit;
}

solvers::ConeSolution ClothSimulation::Attempt::projectWithContact(const Eigen::Matrix3Xd& candidate,
                                                                   const Eigen::Matrix3Xd& start, double fraction) {
  const ClothProblem& problem = *simulation.problem_;
  solvers::ConeProgramOptions options = simulation.options_.projection.cone;
  options.relativeGap = std::max(options.relativeGap, contactRelativeGap);
  const double begin = simulation.state_.time, step = simulation.options_.timeStep;
  const ContactMotion motion{
      bodyPointsAt(problem, begin + projectedFraction * step), bodyPointsAt(problem, begin + fraction * step)};
  projectedFraction = fraction;
  return simulation.contactProjection_->project(
      candidate, start, motion, simulation.potential_.terms().rate, options, context);
}

bool ClothSimulation::stepOnce(Attempt& attempt) {
  const double h = options_.timeStep;
  const bool multistep =
      (options_.scheme == SteppingScheme::bdf2 || options_.scheme == SteppingScheme::bdf2AndProject) &&
      state_.earlierPositions.cols() > 0;
  const StepTerms terms = multistep ? bdf2Terms(attempt.x, attempt.v, state_.earlierPositions.reshaped(),
                                                state_.earlierVelocities.reshaped(), h)
                                    : eulerTerms(attempt.x, attempt.v, h);
  Vector x1;
  if (!attempt.advance(terms, attempt.x, 1, x1) || !attempt.project(x1, 1)) return false;
  attempt.next.positions = asPoints(x1);
  attempt.next.velocities = asPoints(terms.rate * (x1 - terms.base));
  attempt.next.earlierPositions = state_.positions;
  attempt.next.earlierVelocities = state_.velocities;
  return true;
}

bool ClothSimulation::stepReflected(Attempt& attempt) {
  const double half = 0.5 * options_.timeStep;
  const bool twoSteps = options_.scheme == SteppingScheme::bdf2AndReflect;
  const StepTerms first = twoSteps && state_.earlierPositions.cols() > 0
                              ? bdf2Terms(attempt.x, attempt.v, state_.earlierPositions.reshaped(),
                                          state_.earlierVelocities.reshaped(), half)
                              : eulerTerms(attempt.x, attempt.v, half);
  Vector candidate;
  if (!attempt.advance(first, attempt.x, 0.5, candidate)) return false;
  Vector middle = candidate;
  if (!attempt.project(middle, 0.5)) return false;
  const Vector velocity = first.rate * (middle - first.base);
  const Vector reflected = 2 * middle - candidate;
  const StepTerms second = twoSteps
                               ? bdf2Terms(reflected, velocity, attempt.x + 2 * (middle - candidate), attempt.v, half)
                               : eulerTerms(reflected, velocity, half);
  Vector x1;
  if (!attempt.advance(second, reflected, 1, x1) || !attempt.project(x1, 1)) return false;
  attempt.next.positions = asPoints(x1);
  attempt.next.velocities = asPoints(second.rate * (x1 - second.base));
  attempt.next.earlierPositions = asPoints(middle);
  attempt.next.earlierVelocities = asPoints(velocity);
  return true;
}

bool ClothSimulation::stepSecondOrder(Attempt& attempt) {
  const double half = 0.5 * options_.timeStep;
  Vector middle;
  if (!attempt.advance(eulerTerms(attempt.x, attempt.v, half), attempt.x, 0.5, middle) || !attempt.project(middle, 0.5))
    return false;
  const Vector velocity = (middle - attempt.x) / half;
  const Vector reflected = withPins(2 * middle - attempt.x, 1);
  Vector x1 = reflected;
  if (!attempt.project(x1, 1)) return false;
  attempt.next.positions = asPoints(x1);
  attempt.next.velocities = asPoints(2 * velocity - attempt.v + (x1 - reflected) / half);
  for (std::size_t node = 0; node < sheet_.fixed.size(); ++node)
    if (sheet_.fixed[node]) {
      const auto column = static_cast<Eigen::Index>(node);
      attempt.next.velocities.col(column) =
          (attempt.next.positions.col(column) - state_.positions.col(column)) / options_.timeStep;
    }
  return true;
}

}  // namespace pliant::cloth
