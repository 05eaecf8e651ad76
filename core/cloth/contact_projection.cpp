#include "core/cloth/contact_projection.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/cloth/contact_system.hpp"
#include "core/solvers/cone_certificate.hpp"

namespace pliant::cloth {

using base::TerminationType;
using Positions = Eigen::Matrix3Xd;

namespace {

/// Limits are tightened by this factor, so that what keeps the tight ones but for a residual keeps the true ones.
constexpr double tightening = 1 - 1e-10;
/// More room than where there is no contact, which may be in the way as well.
constexpr solvers::ConeElements::StartingSlack startingSlack{0.0025, 0.0025};
/// Fraction of the way to the boundary of the cones.
constexpr double stepFraction = 0.99;
/// Corrections of one predictor, and the step length with which nothing is left to gain by more of them.
constexpr int mostCorrections = 4;
constexpr double longEnough = 0.95;
constexpr double smallestGain = 0.02;
/// So much of the contacts' negative curvature is taken away, one after the other, until there is a step so long.
constexpr std::array convexities = {0.0, 0.05, 0.25, 1.0};
constexpr double shortStep = 0.3;
constexpr int levelsKept = 3;  ///< iterations for which a convexity stays where a smaller one was too small
/// The barrier that is aimed at where steps are short, times the present one.
constexpr double recentring = 10;
constexpr double largestInertia = 1e12;
/// What the barrier of the limits stays above: parts of what Newton's method has left to gain, and of the gap asked
/// for. Else slacks vanish before contact has been found.
constexpr double barrierOfGain = 0.3;
constexpr double barrierOfTolerance = 0.1;
constexpr double armijo = 1e-4;
constexpr double drownedGain = 1e-12;  ///< of the contact energy
constexpr int mostHalvings = 12;
/// A step that contact cuts short ends a little earlier: gaps that are very small take long to open again.
constexpr double beforeContact = 0.8;
constexpr double stallingStep = 0.02;
constexpr int mostStalls = 10;      ///< so many steps so short in succession
constexpr int mostRestarts = 2;     ///< with a larger barrier
constexpr int longestSearch = 3;    ///< times the iterations asked for, since contacts are found one after the other
constexpr double leastMove = 1e-3;  ///< of bodies and held nodes at a time; less counts as stuck

}  // namespace

struct ContactProjection::Implementation {
  Implementation(solvers::ConeConstraints given, std::shared_ptr<mechanics::ContactBarrier> barrier)
      : constraints(std::move(given)), contact(barrier), system(tightened(constraints), std::move(barrier)) {}

  static solvers::ConeConstraints tightened(solvers::ConeConstraints constraints) {
    for (solvers::MetricBounds& bounds : constraints.bounds) {
      for (Eigen::Matrix2d& ellipse : bounds.ellipses) ellipse *= tightening * tightening;
      for (Eigen::Vector2d& direction : bounds.directions) direction /= tightening;
    }
    return constraints;
  }

  Positions withBodies(const Positions& x) const {
    Positions all(3, x.cols() + bodies.cols());
    all << x, bodies;
    return all;
  }

  double distance(const Positions& x) const {
    return 0.5 * ((x - *candidate).colwise().squaredNorm() * constraints.masses).value();
  }

  bool keepsLimits(const Positions& x) { return system.elements().largestStretch(x) * tightening < 1; }

  /// Moves bodies and held nodes on towards `to` (bodies included), as far as nothing is in the way. True if they have
  /// arrived.
  bool moveOn(Positions& x, const Positions& to) {
    Positions motion = Positions::Zero(3, to.cols());
    for (int node = 0; node < constraints.nodeCount; ++node)
      if (constraints.fixed[node]) motion.col(node) = to.col(node) - x.col(node);
    motion.rightCols(bodies.cols()) = to.rightCols(bodies.cols()) - bodies;
    if (motion.isZero(0)) return true;
    double step = contact->largestStep(withBodies(x), motion);
    if (step < 1) step *= 0.5;  // the sheet needs room to get out of the way
    x += step * motion.leftCols(x.cols());
    bodies += step * motion.rightCols(bodies.cols());
    if (step == 1) {
      for (int node = 0; node < constraints.nodeCount; ++node)
        if (constraints.fixed[node]) x.col(node) = to.col(node);
      bodies = to.rightCols(bodies.cols());
    }
    contact->update(withBodies(x));
    return step == 1;
  }

  struct Direction {
    Positions dx;
    double length = 0;  ///< of the step to which limits and contact let it be cut
    double power = 0;   ///< dxᵀ K dx
  };

  /// Predictor and corrections with the factors there are.
  void direct(const Positions& x, const Positions& gradient, const Positions& predictorForces, double complementarity,
              double tolerance, Direction& direction) {
    solvers::ConeElements& elements = system.elements();
    Positions right = -(gradient + predictorForces), dx = Positions::Zero(3, x.cols()), forces(3, x.cols());
    elements.clearCorrection();
    system.solve(right, dx);
    const double affine = std::min(1.0, stepFraction * elements.direct(dx));
    const double bounds = std::max(1, elements.boundCount());
    const double barrier = complementarity / bounds;
    const double ratio = complementarity > 0 ? elements.complementarityAfter(affine) / complementarity : 0;
    const double gain = 0.5 * right.cwiseProduct(dx).sum();
    const double floor = std::max(barrierOfGain * gain, barrierOfTolerance * tolerance) / bounds;
    const double target = std::max(ratio * ratio * ratio * barrier, std::min(floor, barrier));
    direction.length = 0;
    const auto tryCorrection = [&](double towards, double weight) {
      forces.setZero();
      elements.correct(towards, weight, forces);
      right = -(gradient + forces);
      system.solve(right, dx);
      const double step = std::min(1.0, stepFraction * elements.direct(dx));
      if (direction.length > 0 && step < direction.length + smallestGain) return false;
      direction = {dx, step, right.cwiseProduct(dx).sum()};
      elements.keepDirection();
      return step <= longEnough;
    };
    for (int correction = 0; correction < mostCorrections && tryCorrection(target, 1); ++correction) {
    }
    // Products of whole steps mislead where they are short, and slacks are too small for what is to be moved.
    if (direction.length < shortStep) tryCorrection(recentring * barrier, 0);
    elements.restoreDirection();
    Positions motion = Positions::Zero(3, x.cols() + bodies.cols());
    motion.leftCols(x.cols()) = direction.length * direction.dx;
    const double free = contact->largestStep(withBodies(x), motion);
    direction.length *= free < 1 ? beforeContact * free : 1;
  }

  /// Goes along the direction as far as the contact energy is not above its quadratic model by more than the model's
  /// decrease; what is not of the contacts is quadratic but for the limits' slacks. Leaves the contacts of the new x.
  void advance(const Direction& direction, const Positions& push, Positions& x) {
    const double before = scale * contact->value(), slope = scale * push.cwiseProduct(direction.dx).sum();
    const double curvature = scale * system.contactCurvature(direction.dx);
    double step = direction.length;
    for (int halving = 0;; ++halving) {
      const Positions trial = x + step * direction.dx;
      contact->update(withBodies(trial));
      const double excess = scale * contact->value() - before - step * slope - 0.5 * step * step * curvature;
      if (excess <= ((1 - armijo) * step - 0.5 * step * step) * direction.power + drownedGain * before ||
          halving == mostHalvings) {
        x = trial;
        break;
      }
      step *= 0.5;
    }
    system.elements().advance(step);
  }

  /// Held nodes and bodies go to `to`, and the sheet to its projection.
  TerminationType minimize(Positions& x, const Positions& to, const solvers::ConeProgramOptions& options, double least,
                           base::ExecutionContext& context, base::SolverReport& report);

  const solvers::ConeConstraints constraints;
  std::shared_ptr<mechanics::ContactBarrier> contact;
  ContactSystem system;  ///< with tight limits
  const Positions* candidate = nullptr;
  Positions bodies;
  double scale = 1;  ///< of the contact energy: 1 / rate²
  bool hasMultipliers = false;
  double lastObjective = 0;
};

TerminationType ContactProjection::Implementation::minimize(Positions& x, const Positions& to,
                                                            const solvers::ConeProgramOptions& options, double least,
                                                            base::ExecutionContext& context,
                                                            base::SolverReport& report) {
  solvers::ConeElements& elements = system.elements();
  contact->update(withBodies(x));
  bool arrived = moveOn(x, to);
  if (arrived && keepsLimits(*candidate)) {  // the candidate may be its own projection
    Positions ahead = Positions::Zero(3, to.cols());
    ahead.leftCols(x.cols()) = *candidate - x;
    if (contact->largestStep(withBodies(x), ahead) == 1) {
      contact->update(withBodies(*candidate));
      if (contact->value() == 0) {
        x = *candidate;
        elements.start(x, 0, false, startingSlack);
        hasMultipliers = false;
        report.iterations.push_back({});
        return TerminationType::converged;
      }
      contact->update(withBodies(x));
    }
  }
  const double farthest = std::max(distance(x), least);
  const double expected = lastObjective > 0 ? std::clamp(lastObjective, 1e-4 * farthest, farthest) : farthest;
  const bool warm = options.warmStart && hasMultipliers;
  double barrier0 = (warm ? 1 : 10) * expected / std::max(1, elements.boundCount());
  elements.start(x, barrier0, warm, startingSlack);
  hasMultipliers = false;
  Positions forces(3, x.cols()), predictorForces(3, x.cols()), push(3, x.cols()), gradient(3, x.cols());
  Direction direction;
  std::size_t level = 0;
  int kept = 0, stalled = 0, restarts = 0;
  for (int iteration = 0;; ++iteration) {
    if (!arrived) arrived = moveOn(x, to);
    double inertia = 1;
    const auto assemble = [&] {
      return system.assemble(x, scale, inertia, convexities[level], forces, predictorForces);
    };
    const std::size_t lastLevel = level;
    if (level > 0 && --kept <= 0) --level;
    const auto at = assemble();
    push.setZero();
    contact->addGradient(push);
    gradient = (x - *candidate) * constraints.masses.asDiagonal();
    gradient += scale * push;
    double squaredResidual = 0;
    for (const int node : system.freeNodes())
      squaredResidual += (gradient.col(node) + forces.col(node)).squaredNorm() / constraints.masses[node];
    const double gap = 0.5 * squaredResidual + at.supportGap, objective = distance(x);
    const double tolerance = std::max(options.relativeGap * objective, least);
    report.iterations.push_back({static_cast<int>(report.iterations.size()), std::abs(gap) / std::max(objective, least),
                                 0, std::max(0.0, at.largestStretch * tightening - 1)});
    if (!std::isfinite(gap)) return TerminationType::failed;
    if (arrived && std::abs(gap) <= tolerance && at.largestStretch * tightening < 1) {
      hasMultipliers = true;
      lastObjective = objective;
      return TerminationType::converged;
    }
    if (context.cancelRequested()) return TerminationType::cancelled;
    if (iteration >= longestSearch * options.maximumIterations) return TerminationType::iterationLimit;

    direction.length = 0;
    while (true) {
      if (system.factorize()) {
        direct(x, gradient, predictorForces, at.complementarity, tolerance, direction);
        if (direction.length >= shortStep || level + 1 == convexities.size()) break;
      }
      if (level + 1 < convexities.size())
        ++level;
      else if ((inertia *= 100) > largestInertia)
        return TerminationType::failed;
      assemble();
    }
    if (level > lastLevel || (level == lastLevel && kept <= 0)) kept = levelsKept;
    advance(direction, push, x);
    report.iterations.back().stepLength = direction.length;
    stalled = direction.length < stallingStep ? stalled + 1 : 0;
    if (stalled < mostStalls) continue;
    if (restarts++ == mostRestarts) return TerminationType::iterationLimit;
    stalled = 0;
    elements.start(x, barrier0 *= 100, false, startingSlack);
  }
}

ContactProjection::ContactProjection(solvers::ConeConstraints constraints,
                                     std::shared_ptr<mechanics::ContactBarrier> contact)
    : implementation_(std::make_unique<Implementation>(std::move(constraints), std::move(contact))) {}
ContactProjection::~ContactProjection() = default;

solvers::ConeSolution ContactProjection::project(const Positions& candidate, const Positions& start,
                                                 const ContactMotion& motion, double rate,
                                                 const solvers::ConeProgramOptions& options,
                                                 base::ExecutionContext& context, Positions* reached) {
  const base::Stopwatch stopwatch;
  Implementation& own = *implementation_;
  solvers::ConeSolution solution;
  base::SolverReport& report = solution.report;
  own.candidate = &candidate;
  own.bodies = motion.bodiesFrom;
  own.scale = 1 / (rate * rate);
  own.contact->update(own.withBodies(start));
  if (!own.keepsLimits(start))
    throw base::InputError("", "A projection with contact must start inside the stretch limits.");
  if (!std::isfinite(own.contact->value()))
    throw base::InputError("", "A projection with contact must start without contact.");
  const double size = (candidate.rowwise().maxCoeff() - candidate.rowwise().minCoeff()).norm();
  const double least = options.absoluteGap * own.constraints.masses.sum() * size * size;

  // All at once, or in parts: `free` and `freeBodies` are what has been reached within the limits.
  Positions free = start, freeBodies = motion.bodiesFrom;
  TerminationType termination = TerminationType::failed;
  double part = 1;
  while (true) {
    Positions to = own.withBodies(candidate);
    to.rightCols(own.bodies.cols()) = motion.bodiesTo;
    const Positions from = own.withBodies(free);
    bool moves = false;
    for (Eigen::Index node = 0; node < to.cols(); ++node)
      if (node >= free.cols() || own.constraints.fixed[node]) moves |= to.col(node) != from.col(node);
    if (part < 1) to = from + part * (to - from);
    Positions x = free;
    termination = own.minimize(x, to, options, least, context, report);
    const bool arrived = own.bodies == to.rightCols(own.bodies.cols());
    if (termination != TerminationType::converged && !moves) {
      // On the way to what was found limits hold up to some place, for they are convex.
      Positions ahead = Positions::Zero(3, to.cols());
      ahead.leftCols(x.cols()) = x - free;
      double step = x.allFinite() ? own.contact->largestStep(from, ahead) : 0;
      for (int halving = 0; halving < 60 && !own.keepsLimits(free + step * ahead.leftCols(x.cols())); ++halving)
        step *= 0.5;
      free += step * ahead.leftCols(x.cols());
      break;
    }
    const bool feasible = arrived && x.allFinite() && own.keepsLimits(x);
    if (feasible) {
      free = x;
      freeBodies = own.bodies;
    }
    own.bodies = freeBodies;
    if (termination == TerminationType::cancelled || (feasible && part == 1)) break;
    part = feasible ? 1 : 0.5 * part;
    if (part < leastMove) {
      termination = TerminationType::failed;
      break;
    }
  }

  // The contact forces as they are make a convex problem, of which this is the solution.
  solution.positions = free;
  own.contact->update(own.withBodies(free));
  own.system.elements().report(solution);
  Positions push = Positions::Zero(3, free.cols());
  own.contact->addGradient(push);
  for (int node = 0; node < own.constraints.nodeCount; ++node)
    push.col(node) *= own.constraints.fixed[node] ? 0 : own.scale / own.constraints.masses[node];
  solvers::certify(own.constraints, candidate - push, solution);
  const double gap = solution.gap();  // of that problem; the objective is reported of this one
  solution.objective = own.distance(free);
  solution.bound = solution.objective - gap;
  report.termination = termination;
  if (termination == TerminationType::cancelled) report.message = "The projection was cancelled.";
  if (termination == TerminationType::iterationLimit)
    report.message = "The projection keeps limits and contact, but it is not as near to the candidate as asked.";
  if (termination == TerminationType::failed)
    report.message = "A body or a held node cannot get on without breaking a stretch limit or going through the cloth.";
  report.seconds = stopwatch.seconds();
  if (reached) *reached = freeBodies;
  return solution;
}

}  // namespace pliant::cloth
