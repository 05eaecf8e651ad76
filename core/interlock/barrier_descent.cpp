#include "core/interlock/barrier_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/interlock/swept_contact.hpp"

namespace pliant::interlock {

namespace {

using base::TerminationType;
using Eigen::VectorXd;

/// Of the smallest gap a step leaves at least so much: a contact that is far nearer than it will be in the end takes
/// many steps to recover.
constexpr double keptGap = 0.1;

/// With friction barriers get no lighter than this, over what balances all that pulls at the final gap.
constexpr double lightestOfDrag = 1e-4;

/// Of the barrier's range: parts that were farther apart come as near as this in one step.
constexpr double withinRange = 0.3;

/// EquilibriumOptions::firstGap of cells with thin pieces: a mesh has thousands of parts within the radius of a wire,
/// which is what makes wide barriers slow, and does not need them, since its steps are safe at any gap.
constexpr double firstGapOfMeshes = 0.01;

}  // namespace

int splitAtGap(double gap, double radius) { return gap > 0.03 * radius ? 1 : gap > 3e-3 * radius ? 2 : 4; }

BarrierDescent::BarrierDescent(const CellContact& contact, const CellState& start, double radius,
                               const base::ExecutionContext* context)
    : contact_(contact),
      start_(start),
      radius_(radius),
      pathLimit_(0.95 * 4 * radius),
      trust_(0.25 * pathLimit_),
      state_(start),
      thin_(contact.hasThinPieces()),
      context_(context) {}

VectorXd BarrierDescent::pathBeyond(const VectorXd&) const { return VectorXd::Zero(state_.positions.cols()); }

double BarrierDescent::costOf(const CellState& state) const {
  return objective(state) + (friction_ ? friction_->energy(state) : 0);
}

double BarrierDescent::collisionFreeStep(const VectorXd& velocity, double step, double range) const {
  const VectorXd motion = step * velocity;
  return step *
         safeFraction(contact_, state_, motion, pathBeyond(motion), 2 * (range + pathLimit_), withinRange * range);
}

BarrierDescent::Outcome BarrierDescent::minimize(const CellContact::Barrier& barrier, double tolerance,
                                                 int maximumIterations) {
  pairs_ = contact_.nearParts(state_, barrier.range);
  int creeping = 0;
  while (true) {
    if (context_ && context_->cancelRequested()) return Outcome::cancelled;
    double gap = 0;
    const double energy = linearize(barrier, gap) + costOf(state_);
    if (!std::isfinite(energy)) return Outcome::noProgress;
    const VectorXd velocity = direction();
    if (decrement_ <= tolerance * barrier.weight) return Outcome::minimum;
    // Where two nearest places of a pair of arcs are about to become one the energy has small kinks, at which Newton's
    // method creeps; below the weight there is no more to gain than contact itself costs.
    const bool settled = decrement_ <= barrier.weight;
    creeping = settled ? creeping + 1 : 0;
    if (creeping > 10) return Outcome::minimum;
    if (iterations_ >= maximumIterations) return Outcome::iterationLimit;
    ++iterations_;

    double step = largestStep(velocity, barrier.range);
    const double shortest = 1e-10 * step;
    if (thin_) {
      step = collisionFreeStep(velocity, step, barrier.range);
    } else {
      const double path = step * relativePath(velocity, 2 * (barrier.range + pathLimit_));
      pairs_ = contact_.nearParts(state_, barrier.range + path);
    }
    CellState next;
    for (const double longest = step;; step *= 0.5) {
      if (step < shortest) return settled ? Outcome::minimum : Outcome::noProgress;
      next = advanced(state_, velocity, step);
      // Of meshes far more parts are near than those that are near in the end.
      if (thin_) pairs_ = contact_.nearParts(next, barrier.range);
      double nextGap = 0;
      const double trial = contact_.energy(next, pairs_, barrier, nullptr, nullptr, &nextGap) + costOf(next);
      if (trial > energy - 1e-4 * step * decrement_ || !(nextGap >= keptGap * gap)) continue;
      if (step < 0.5 * longest)
        trust_ = std::max(0.25 * trust_, 1e-6 * pathLimit_);
      else if (step == longest)
        trust_ = std::min(2 * trust_, 0.25 * pathLimit_);
      break;
    }
    state_ = next;
    if (hasReached()) return Outcome::reached;
    if (isUnlimited()) return Outcome::unlimited;
  }
}

void BarrierDescent::measure(const CellContact::Barrier& barrier, CellEquilibrium& result) {
  pairs_ = contact_.nearParts(state_, barrier.range);
  contact_.energy(state_, pairs_, barrier, nullptr, nullptr, nullptr, &result.contacts);
  result.remaining = 0;
  result.smallestGap = barrier.range;
  double forces = 0;
  for (const CellContactForce& each : result.contacts) {
    result.remaining += each.force * each.gap;
    forces += each.force;
    result.smallestGap = std::min(result.smallestGap, each.gap);
  }
  result.meanGap = forces > 0 ? result.remaining / forces : 0;
  result.remaining += decrement_;
}

CellState BarrierDescent::relax(const EquilibriumOptions& options, double tolerance) {
  minimize({1, radius_}, tolerance, options.maximumIterations);
  return state_;
}

CellEquilibrium BarrierDescent::settle(const CellContact::Barrier& barrier, double tolerance, int maximumIterations) {
  CellEquilibrium result;
  const Outcome outcome = minimize(barrier, tolerance, maximumIterations);
  measure(barrier, result);
  finish(outcome, barrier, result);
  return result;
}

CellEquilibrium BarrierDescent::run(const EquilibriumOptions& options) {
  CellEquilibrium result;
  const double finalGap = options.finalGap * radius_;
  const double firstGap = thin_ ? std::min(options.firstGap, firstGapOfMeshes) : options.firstGap;
  CellContact::Barrier barrier{weightFor(firstGap * radius_), radius_};
  if (thin_) barrier.range *= std::min(1.0, options.rangeRatio * firstGap);
  Outcome outcome = Outcome::minimum;
  double predicted = std::numeric_limits<double>::infinity();
  // While it is the drag of friction that holds the structure, contacts push little, and are not near.
  const double lightest = friction_ ? lightestOfDrag * weightFor(finalGap) : 0;
  while (true) {
    const bool light = barrier.weight <= lightest, last = predicted <= finalGap || light;
    outcome = minimize(barrier, last ? 1e-4 : options.looseTolerance, options.maximumIterations);
    measure(barrier, result);
    if (outcome != Outcome::minimum && outcome != Outcome::noProgress) break;
    if (last && (result.meanGap <= finalGap || light || outcome == Outcome::noProgress)) break;
    if (result.contacts.empty() && barrier.range <= options.rangeRatio * finalGap) break;
    // Force times gap is the weight near contact, so that gaps shrink as it does.
    const double gap = result.meanGap > 0 ? result.meanGap : barrier.range / options.rangeRatio;
    const double share = std::max(options.reduction, std::min(0.8 * finalGap / gap, 0.8));
    predicted = share * gap;
    barrier.weight *= share;
    barrier.range = std::clamp(options.rangeRatio * predicted, options.rangeRatio * finalGap, radius_);
    // What holds the cell pushes about as before. A contact that pushes far harder is not in balance: with the
    // stiffness of such a force Newton's method would only double its gap in a step, and creep along curved surfaces,
    // as methods that know the balanced forces (primal-dual ones) do not.
    double largest = 0;
    for (const CellContactForce& contact : result.contacts) largest = std::max(largest, contact.force);
    // Meshes have to see their walls as they are: their steps end where the first of many parts has lost most of its
    // gap, and without its stiffness the next step would end there too.
    if (largest > 0 && !thin_) barrier.largestForce = 4 * largest;
    barrier.split = splitAtGap(predicted, radius_);
  }
  finish(outcome, barrier, result);
  return result;
}

void BarrierDescent::finish(Outcome outcome, const CellContact::Barrier& barrier, CellEquilibrium& result) const {
  result.state = state_;
  result.iterations = iterations_;
  result.weight = barrier.weight;
  result.termination = TerminationType::converged;
  switch (outcome) {
    case Outcome::minimum: result.kind = result.contacts.empty() ? RestKind::reached : RestKind::locked; break;
    case Outcome::reached: result.kind = RestKind::reached; break;
    case Outcome::unlimited: result.kind = RestKind::unlimited; break;
    case Outcome::noProgress:
      result.termination = TerminationType::failed;
      result.message = "the line search found no lower energy";
      break;
    case Outcome::iterationLimit:
      result.termination = TerminationType::iterationLimit;
      result.message = "contact did not settle in " + std::to_string(iterations_) + " iterations";
      break;
    case Outcome::cancelled:
      result.termination = TerminationType::cancelled;
      result.message = "cancelled";
      break;
  }
}

}  // namespace pliant::interlock
