#include "core/cloth/cloth_drape.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_certificate.hpp"

namespace pliant::cloth {

using base::TerminationType;

namespace {

/// How far apart the two parts of the unbalanced force may be, and by how much the step then changes.
constexpr double largestImbalance = 3;
constexpr double stepChange = 1.3;
constexpr double shortestStep = 1e-5;
/// Steps from one change to the next where there are limits: the method converges for any h, but not for any sequence.
constexpr int stepsBetweenChanges = 3;
/// Where the energy is not convex (a sheet that crumples), the method may circle unless h is small enough: h is bounded
/// by less wherever the residual has not fallen by this factor in so many steps.
constexpr double progressFactor = 0.9;
constexpr int patience = 150;
constexpr double boundChange = 1.6;

/// Of Newton's method: how the step grows, Armijo's condition, and where the line search gives up.
constexpr double stepGrowth = 2;
constexpr double stepCut = 8;
constexpr double largestGrowth = 200;  ///< of h; inertia is nothing then, and a matrix without it is all but singular
constexpr double leastDecrease = 1e-4;
constexpr double shortestFraction = 1e-6;
constexpr double energyRounding = 1e-13;

/// Norm over the nodes that are not held.
double freeNorm(const Eigen::Matrix3Xd& forces, const std::vector<char>& held) {
  double sum = 0;
  for (Eigen::Index node = 0; node < forces.cols(); ++node)
    if (!held[static_cast<std::size_t>(node)]) sum += forces.col(node).squaredNorm();
  return std::sqrt(sum);
}

}  // namespace

ClothDrape::ClothDrape(std::shared_ptr<const ClothProblem> problem, DrapeOptions options, LimiterFactory makeLimiter)
    : problem_((checkClothProblem(*problem), std::move(problem))),
      options_(std::move(options)),
      potential_(problem_),
      sheet_(problem_->sheet),
      timeStep_(options_.timeStep) {
  for (const double value : {options_.tolerance, options_.timeStep})
    if (!(std::isfinite(value) && value > 0))
      throw base::InputError("", "the tolerance and the time step of a drape must be numbers above 0");
  sheet_.fixed = heldNodes(*problem_, options_.time);
  potential_.setHeld(sheet_.fixed);
  const bool limited = options_.limitMethod != "none" && hasLimits(sheet_);
  contact_ = makeContactBarrier(*problem_);
  if (contact_) {
    checkContactOptions(options_.limitMethod, ProjectionNorm::mass);
    LimitedSheet sheet = sheet_;
    if (!limited)
      for (SheetTriangle& triangle : sheet.triangles) triangle.limit = -1;
    contactProjection_ =
        std::make_unique<ContactProjection>(sheetCones(sheet, ProjectionNorm::mass).constraints, contact_);
  } else if (limited) {
    const SheetCones cones = sheetCones(sheet_, ProjectionNorm::mass);
    if (options_.limitMethod == "cone" && !makeLimiter)
      program_ = std::make_unique<solvers::ConeProgram>(
          cones.constraints, solvers::ConeStiffness{potential_.hessianRows(), potential_.hessianColumns()});
    else
      limiter_ = makeLimiter ? makeLimiter(cones)
                             : makeStrainLimiter(options_.limitMethod, cones.constraints, options_.projection);
  }
  const Eigen::Index nodes = problem_->model->nodeCount();
  positions_ = problem_->model->restPositions.reshaped(3, nodes);
  placePins(*problem_, options_.time, positions_);
  if (contact_) contact_->requireFree(withBodies(*problem_, positions_, options_.time));
  limitForces_.setZero(3, nodes);
}

solvers::ConeSolution ClothDrape::project(const Eigen::Matrix3Xd& candidate, base::ExecutionContext& context) {
  if (!contactProjection_) return limiter_->project(candidate, positions_, context);
  const Eigen::Matrix3Xd bodies = bodyPointsAt(*problem_, options_.time);
  solvers::ConeProgramOptions options = options_.projection.cone;
  options.relativeGap = std::max(options.relativeGap, contactRelativeGap);
  return contactProjection_->project(candidate, positions_, {bodies, bodies}, 1 / timeStep_, options, context);
}

DrapeRecord ClothDrape::step(base::ExecutionContext& context) {
  DrapeRecord record = program_ ? newtonStep(context) : splitStep(context);
  record.residual = residual_;
  record.step.energies = energiesAt(*problem_, positions_, Eigen::Matrix3Xd::Zero(3, positions_.cols()));
  if (contact_) {
    const Eigen::Matrix3Xd all = withBodies(*problem_, positions_, options_.time);
    contact_->update(all);
    record.step.energies.contact = contact_->value();
    record.step.smallestGap = contact_->smallestGap(all);
  }
  if (!sheet_.limits.empty()) record.step.violation = std::max(0.0, stretchRatios(sheet_, positions_).maxCoeff() - 1);
  return record;
}

StepTerms ClothDrape::termsFrom(const Vector& x) const {
  StepTerms terms;
  terms.rate = 1 / timeStep_;
  terms.base = terms.target = x;
  if (problem_->model->stiffnessDamping != 0) terms.history = potential_.elasticForce(terms.base);
  return terms;
}

double ClothDrape::momentum() {
  const double last = weight_;
  weight_ = 0.5 * (1 + std::sqrt(1 + 4 * last * last));
  return (last - 1) / weight_;
}

double ClothDrape::norm(const Vector& force) const {
  return freeNorm(force.reshaped(3, positions_.cols()), sheet_.fixed);
}

DrapeRecord ClothDrape::newtonStep(base::ExecutionContext& context) {
  const Eigen::Index nodes = positions_.cols();
  DrapeRecord record;
  const Vector x = positions_.reshaped();
  potential_.beginWind(positions_, options_.time);
  // From where it would get by going on as before, or else from where it is.
  for (double ahead : {momentum(), 0.0}) {
    const double h = record.timeStep = timeStep_;
    const Vector from = ahead > 0 ? Vector(x + ahead * (x - previous_)) : x;
    potential_.setTerms(termsFrom(from));
    const base::Stopwatch watch;
    const Vector slope = potential_.gradient(from);
    Vector step;
    const auto shorten = [&](std::string message) {  // with more inertia it may go
      timeStep_ = h / stepCut;
      restart();
      if (timeStep_ >= shortestStep) return;
      record.step.termination = TerminationType::failed;
      record.step.message = std::move(message);
    };
    ++record.step.newtonIterations;
    if (!potential_.newtonStep(from, slope, step) ||
        !program_->setStiffness(h * h * potential_.hessianEntries(), h * h * potential_.inertia() - 1)) {
      shorten("No direction lowers the energy of the drape.");
      return record;
    }
    // What the step was in truth, where the Hessian needed more inertia.
    const double taken = 1 / std::sqrt(potential_.inertia());
    record.step.newtonSeconds += watch.seconds();
    const base::Stopwatch projectionWatch;
    auto solution = std::make_shared<solvers::ConeSolution>(
        program_->solve((from + step).reshaped(3, nodes), positions_, options_.projection.cone, context));
    ++record.step.projections;
    record.step.projectionIterations += static_cast<int>(solution->report.iterations.size());
    record.step.projectionSeconds += projectionWatch.seconds();
    record.step.projection = solution;
    if (solution->report.termination == TerminationType::failed) {
      shorten(solution->report.message);
      return record;
    }
    if (!solution->report.converged()) {
      record.step.termination = solution->report.termination;
      record.step.message = solution->report.message;
      if (solution->report.termination != TerminationType::iterationLimit) return record;
    }
    const Vector reached = solution->positions.reshaped(), direction = reached - x;
    double fraction = 1;
    if (ahead > 0) {
      const double lowest = potential_.value(reached);
      potential_.setTerms(termsFrom(x));
      if (!(lowest < potential_.value(x))) {
        restart();
        continue;
      }
    } else {
      const double decrease = -slope.dot(direction), energy = potential_.value(x);
      // The last steps lower the energy by less than its rounding.
      while (fraction > shortestFraction && decrease > energyRounding * std::abs(energy) &&
             !(potential_.value(x + fraction * direction) <= energy - leastDecrease * fraction * decrease))
        fraction *= 0.5;
    }
    // Momentum is lost where it does not lead on (O'Donoghue & Candès 2015).
    if (fraction < 1 || (from - reached).cwiseProduct(potential_.masses()).dot(direction) > 0) restart();
    previous_ = x;
    positions_ = (x + fraction * direction).reshaped(3, nodes);
    timeStep_ =
        std::clamp(taken * (fraction == 1 ? stepGrowth : fraction), shortestStep, largestGrowth * options_.timeStep);
    // With the multipliers that the whole step had.
    solution->positions = positions_;
    limitForces_ = solvers::limitForces(program_->constraints(), *solution) / (h * h);
    for (Eigen::Index node = 0; node < nodes; ++node)
      if (sheet_.fixed[static_cast<std::size_t>(node)]) limitForces_.col(node).setZero();
    const Vector external = potential_.externalForce() + potential_.windForce();
    residual_ = norm(potential_.elasticForce(positions_.reshaped()) - external + Vector(limitForces_.reshaped())) /
                std::max(norm(external), std::numeric_limits<double>::min());
    break;
  }
  return record;
}

DrapeRecord ClothDrape::splitStep(base::ExecutionContext& context) {
  const double h = timeStep_;
  const Vector& masses = potential_.masses();
  const Eigen::Index nodes = positions_.cols();
  DrapeRecord record;
  record.timeStep = h;
  const auto take = [&](const base::SolverReport& report) {
    if (!report.converged()) {
      record.step.termination = report.termination;
      record.step.message = report.message;
    }
    return report.converged() || report.termination == TerminationType::iterationLimit;
  };

  potential_.setTerms(termsFrom(positions_.reshaped()));
  potential_.setExtraForce(-limitForces_.reshaped());
  potential_.beginWind(positions_, options_.time);
  Vector candidate = positions_.reshaped();
  const base::SolverReport newton = potential_.minimize(candidate, options_.newton, context);
  record.step.newtonIterations = static_cast<int>(newton.iterations.size()) - 1;
  record.step.newtonSeconds = newton.seconds;
  bool done = take(newton);

  const Eigen::Matrix3Xd unlimited = candidate.reshaped(3, nodes);
  Eigen::Matrix3Xd next = unlimited, forces = limitForces_;
  const bool projects = limiter_ || contactProjection_;
  if (done && projects) {
    const base::Stopwatch watch;
    Eigen::Matrix3Xd moved = unlimited;
    for (Eigen::Index node = 0; node < nodes; ++node)
      if (!sheet_.fixed[static_cast<std::size_t>(node)]) moved.col(node) += h * h / masses[3 * node] * forces.col(node);
    auto solution = std::make_shared<solvers::ConeSolution>(project(moved, context));
    record.step.projections = 1;
    record.step.projectionIterations = static_cast<int>(solution->report.iterations.size());
    record.step.projectionSeconds = watch.seconds();
    done = take(solution->report);
    next = solution->positions;
    for (Eigen::Index node = 0; node < nodes; ++node)
      forces.col(node) = sheet_.fixed[static_cast<std::size_t>(node)]
                             ? Eigen::Vector3d::Zero()
                             : Eigen::Vector3d(masses[3 * node] / (h * h) * (moved.col(node) - next.col(node)));
    record.step.projection = std::move(solution);
  }
  if (done) {
    const Vector elastic = potential_.elasticForce(next.reshaped());
    const Vector external = potential_.externalForce() + potential_.windForce();
    const Vector unbalanced = elastic - external + Vector(forces.reshaped());
    const Vector splitting = elastic - potential_.elasticForce(candidate);
    const Vector motion = masses.cwiseProduct((next - positions_).reshaped()) / (h * h);
    residual_ = norm(unbalanced) / std::max(norm(external), std::numeric_limits<double>::min());
    if (++sinceChange_ >= (projects ? stepsBetweenChanges : 1)) {
      sinceChange_ = 0;
      if (norm(splitting) > largestImbalance * norm(motion)) timeStep_ = std::max(shortestStep, h / stepChange);
      if (norm(motion) > largestImbalance * norm(splitting)) timeStep_ = h * stepChange;
    }
    if (residual_ < progressFactor * bestResidual_) {
      bestResidual_ = residual_;
      sinceProgress_ = 0;
    } else if (projects && ++sinceProgress_ >= patience) {
      longestStep_ = h / boundChange;
      bestResidual_ = residual_;
      sinceProgress_ = 0;
    }
    timeStep_ = std::clamp(timeStep_, shortestStep, std::max(shortestStep, longestStep_));
    positions_ = next;
    limitForces_ = forces;
  }
  return record;
}

}  // namespace pliant::cloth
