#include "core/harmonic/design_branch.hpp"

#include <algorithm>
#include <limits>

#include "core/harmonic/motion_corrector.hpp"
#include "core/mechanics/drive_frequency.hpp"

namespace pliant::harmonic {

DesignBranch::DesignBranch(const HarmonicBalanceProblem& first, const InverseDesignOptions& options,
                           base::ExecutionContext& context)
    : first_(first), indices_(options.parameters), options_(options), context_(context) {
  const Model& model = first_.model();
  const auto count = static_cast<Eigen::Index>(options.parameters.size());
  lower_.resize(count);
  ranges_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int index = options.parameters[static_cast<std::size_t>(i)];
    parameters_.push_back(model.parameters.at(static_cast<std::size_t>(index)));
    lower_[i] = parameters_.back()->minimum(model);
    ranges_[i] = parameters_.back()->maximum(model) - lower_[i];
  }
}

Vector DesignBranch::firstVariables() const {
  Vector variables(ranges_.size());
  for (Eigen::Index i = 0; i < ranges_.size(); ++i)
    variables[i] = (parameters_[static_cast<std::size_t>(i)]->value(first_.model()) - lower_[i]) / ranges_[i];
  return variables;
}

double DesignBranch::omegaOf(const HarmonicBalanceProblem& problem) const {
  return mechanics::driveFrequency(problem.model()).value_or(options_.omega);
}

DesignPoint DesignBranch::begin() {
  DesignPoint point;
  point.variables = firstVariables();
  point.motion = solvePeriodicMotion(first_, omegaOf(first_), options_.motion, context_);
  point.problem = std::make_shared<const HarmonicBalanceProblem>(first_);
  addCost(first_.cost());
  if (point.motion.report.converged()) complete(point);
  if (point.motion.report.converged() && point.motion.factorization)
    sign_ = point.motion.factorization->determinantSign();
  return point;
}

DesignPoint DesignBranch::beginAt(const Vector& z) {
  DesignPoint point;
  point.variables = firstVariables();
  point.motion.omega = omegaOf(first_);
  point.motion.z = z;
  point.problem = std::make_shared<const HarmonicBalanceProblem>(first_);
  JacobianSolver solver(*point.problem);
  Vector h;
  solver.linearize(z, point.motion.omega, h, nullptr);
  point.motion.report.iterations.push_back({0, h.norm() / first_.forceScale(point.motion.omega), 0, 0});
  if (!solver.factorize()) return point;
  point.motion.report.termination = base::TerminationType::converged;
  point.motion.factorization = solver.factorization();
  sign_ = point.motion.factorization->determinantSign();
  complete(point);
  return point;
}

bool DesignBranch::follow(DesignPoint& point, const Vector& variables) {
  const Vector start = point.variables, change = variables - start;
  double done = 0, share = 1;
  while (share >= options_.smallestShare && !context_.cancelRequested()) {
    const bool whole = done + share >= 1;
    auto next = tryStep(point, whole ? variables : Vector(start + (done + share) * change));
    if (!next) {
      share /= 2;
      continue;
    }
    point = std::move(*next);
    if (whole) return true;
    done += share;
    share = std::min(2 * share, 1 - done);
  }
  return false;
}

std::optional<DesignPoint> DesignBranch::tryStep(const DesignPoint& from, const Vector& variables) {
  DesignPoint point;
  point.variables = variables;
  auto model =
      std::make_shared<Model>(mechanics::withParameterValues(from.problem->model(), parameters_, valuesOf(variables)));
  const auto problem = std::make_shared<HarmonicBalanceProblem>(
      std::move(model), first_.basis(), first_.drivePeriods(), first_.coordinateHarmonics());
  point.problem = problem;
  point.motion.omega = omegaOf(*problem);

  const math::SparseFactorization& factors = *from.motion.factorization;
  const Vector change = ranges_.cwiseProduct(variables - from.variables);
  const Vector motionChange =
      -problem->expanded(factors.solve(problem->restricted(from.byParameters->times(change))));  // (2.4.4)
  const double swing = problem->oscillation(from.motion.z).norm();
  if (!(motionChange.norm() <= 2 * options_.largestSurprise * swing)) return std::nullopt;
  const Vector foretold = from.motion.z + motionChange;
  point.motion.z = foretold;
  point.motion.factorization = from.motion.factorization;
  ++solves_;
  const bool found = correct(point, from, swing);
  addCost(problem->cost());
  if (!found || !((point.motion.z - foretold).norm() <= options_.largestSurprise * swing)) return std::nullopt;
  if (sign_ != 0 && point.motion.factorization->determinantSign() != sign_) return std::nullopt;
  complete(point);
  return point;
}

bool DesignBranch::correct(DesignPoint& point, const DesignPoint& from, double swing) {
  // Stresses extrapolated from the design before are right to first order, unless the rest shape or the drive changed.
  const Vector foretold = point.motion.z;
  if (correctByNewton(point, {from.motion.z, {}, 1, 1})) return true;
  point.motion.z = foretold;
  point.motion.factorization = from.motion.factorization;
  return correctWithOldFactors(point, swing) || correctByNewton(point, {});
}

bool DesignBranch::correctByNewton(DesignPoint& point, StressSource stresses) {
  constexpr int mostIterations = 12;  // beyond which a smaller change of the design is better
  PeriodicMotionOptions options = options_.motion;
  options.maximumIterations = std::min(options.maximumIterations, mostIterations);
  JacobianSolver solver(*point.problem);
  point.motion.report =
      correctMotion(*point.problem, solver, point.motion.omega, options, std::move(stresses), point.motion.z, context_);
  if (solver.factorization()) point.motion.factorization = solver.factorization();
  return point.motion.report.converged();
}

/// A motion that is extrapolated is not true to what is stiff, by second order. The factors of the design before, which
/// know what is stiff, put that right without minding the spurious stresses there. True if nothing else is needed.
bool DesignBranch::correctWithOldFactors(DesignPoint& point, double swing) {
  constexpr int mostCorrections = 40;
  constexpr double slowest = 0.8;  // ratio of successive corrections
  const HarmonicBalanceProblem& problem = *point.problem;
  const double omega = point.motion.omega, scale = problem.forceScale(omega);
  double previous = swing;
  base::SolverReport& report = point.motion.report;
  report = {};
  for (int i = 0; i < mostCorrections && !context_.cancelRequested(); ++i) {
    const Vector residual = problem.residual(point.motion.z, omega);
    const Vector correction = problem.expanded(point.motion.factorization->solve(problem.restricted(residual)));
    ++problem.cost().solves;
    const double size = correction.norm();
    if (!(size < (i < 3 ? 1 : slowest) * previous)) return false;
    report.iterations.push_back({i, residual.norm() / scale, 1, size / swing});
    point.motion.z -= correction;
    previous = size;
    if (residual.norm() <= options_.motion.tolerance * scale || size <= options_.motion.stepTolerance * swing) {
      report.termination = base::TerminationType::converged;
      return true;
    }
  }
  return false;
}

void DesignBranch::complete(DesignPoint& point) const {
  point.byParameters =
      std::make_shared<const ParameterJacobian>(*point.problem, point.motion.z, point.motion.omega, indices_);
}

void DesignBranch::addCost(const SolutionCost& cost) {
  cost_.evaluations += cost.evaluations;
  cost_.factorizations += cost.factorizations;
  cost_.solves += cost.solves;
  cost_.evaluationSeconds += cost.evaluationSeconds;
  cost_.factorizationSeconds += cost.factorizationSeconds;
  cost_.solveSeconds += cost.solveSeconds;
}

}  // namespace pliant::harmonic
