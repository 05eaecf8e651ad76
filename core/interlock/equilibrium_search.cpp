#include "core/interlock/equilibrium_search.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant::interlock {

namespace {

using base::TerminationType;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Of the smallest gap a step leaves at least so much: a contact that is far nearer than it will be in the end takes
/// many steps to recover.
constexpr double keptGap = 0.1;
constexpr double smallestStretch = 0.05, largestStretch = 20;

}  // namespace

EquilibriumSearch::EquilibriumSearch(const CellSolver& solver, const CellState& start, const StrainDrive& drive,
                                     const base::ExecutionContext* context)
    : solver_(solver),
      contact_(solver.contact_),
      start_(start),
      drive_(drive),
      context_(context),
      pathLimit_(0.95 * 4 * solver.radius_),
      trust_(0.25 * pathLimit_),
      state_(start) {
  const int size = contact_.coordinateCount(), elements = (size - 3) / 6;
  const int free = static_cast<int>(drive.directions.cols());
  basis_ = MatrixXd::Zero(size, 6 * elements - 3 + free);
  for (int i = 3; i < 6 * elements; ++i) basis_(i, i - 3) = i % 6 < 3 ? 1 : 1 / contact_.partsOf(i / 6).reach();
  for (int k = 0; k < free; ++k)
    basis_.block<3, 1>(size - 3, 6 * elements - 3 + k) = drive.directions.col(k) / solver.latticeScale_;
}

double EquilibriumSearch::objective(const CellState& state) const {
  double sum = -travelled(state.strain) + 0.5 * drive_.spring * (state.strain - drive_.target).squaredNorm();
  for (const ElementPull& pull : drive_.pulls)
    sum += energyOf(contact_.cell(), state, pull, placeOf(contact_.cell(), start_, pull));
  return sum;
}

void EquilibriumSearch::addObjective(VectorXd& gradient, MatrixXd* hessian) const {
  gradient.tail<3>() += drive_.spring * (state_.strain - drive_.target) - drive_.load;
  if (hessian) hessian->diagonal().tail<3>().array() += drive_.spring;
  for (const ElementPull& pull : drive_.pulls) addDerivatives(contact_.cell(), state_, pull, gradient, hessian);
}

double EquilibriumSearch::pull() const {
  VectorXd gradient = VectorXd::Zero(contact_.coordinateCount());
  addObjective(gradient, nullptr);
  // The basis has lengths for unknowns.
  return std::max((basis_.transpose() * gradient).norm() * solver_.latticeScale_, 1e-300);
}

VectorXd EquilibriumSearch::direction(const VectorXd& gradient, const MatrixXd& hessian, double& decrement) const {
  const VectorXd reduced = basis_.transpose() * gradient;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(basis_.transpose() * hessian * basis_);
  // Along soft directions, and those that change nothing but rounding errors, as rotations of a ring about its axis,
  // steps end at the trust radius. Others keep their full length, so that gaps can settle while elements slide.
  const VectorXd along = solver.eigenvectors().transpose() * reduced;
  const VectorXd values = solver.eigenvalues().cwiseAbs().cwiseMax(along.cwiseAbs() / trust_);
  const VectorXd step = (values.array() > 0).select(-along.array() / values.array(), 0.0).matrix();
  decrement = -along.dot(step);
  return basis_ * (solver.eigenvectors() * step);
}

double EquilibriumSearch::relativePath(const VectorXd& velocity, double reach) const {
  double farthestOwn = 0, widest = 0, extent = 0;
  for (int i = 0; i < state_.positions.cols(); ++i) {
    const double own = contact_.partsOf(i).reach();
    farthestOwn =
        std::max(farthestOwn, velocity.segment<3>(6 * i).norm() + velocity.segment<3>(6 * i + 3).norm() * own);
    widest = std::max(widest, own);
    extent = std::max(extent, (state_.positions.col(i) - state_.positions.col(0)).norm());
  }
  const Eigen::Matrix2d rate = stretchOf(velocity.tail<3>()) - Eigen::Matrix2d::Identity();
  // Of an image at the translation T: |dF F⁻¹ T|, and T is not longer than what lies between.
  return 2 * farthestOwn + (rate * stretchOf(state_.strain).inverse()).norm() * (reach + 2 * widest + 2 * extent);
}

double EquilibriumSearch::largestStep(const VectorXd& velocity, double range) const {
  // Images farther away than `reach` get no nearer than the range: of their distance d a step takes pathLimit_ and
  // d / 2 at most.
  const double reach = 2 * (range + pathLimit_);
  double step = std::min(1.0, pathLimit_ / relativePath(velocity, reach));
  const Eigen::Matrix2d rate = stretchOf(velocity.tail<3>()) - Eigen::Matrix2d::Identity();
  const double relative = (rate * stretchOf(state_.strain).inverse()).norm();
  if (relative * step > 0.4) step = 0.4 / relative;
  const double speed = drive_.load.dot(velocity.tail<3>());
  if (speed > 0) step = std::min(step, (drive_.farthest - travelled(state_.strain)) / speed);
  return step;
}

bool EquilibriumSearch::isUnlimited() const {
  const auto stretches = stretchOf(state_.strain).selfadjointView<Eigen::Lower>().eigenvalues().eval();
  const double farthest = (state_.positions - start_.positions).cwiseAbs().maxCoeff();
  return stretches.minCoeff() < smallestStretch || stretches.maxCoeff() > largestStretch ||
         farthest > largestStretch * solver_.latticeScale_ * stretches.maxCoeff();
}

EquilibriumSearch::Outcome EquilibriumSearch::minimize(const CellContact::Barrier& barrier, double tolerance) {
  pairs_ = contact_.nearParts(state_, barrier.range);
  int creeping = 0;
  while (true) {
    if (context_ && context_->cancelRequested()) return Outcome::cancelled;
    VectorXd gradient;
    MatrixXd hessian;
    double gap = 0;
    const double energy = contact_.energy(state_, pairs_, barrier, &gradient, &hessian, &gap) + objective(state_);
    if (!std::isfinite(energy)) return Outcome::noProgress;
    addObjective(gradient, &hessian);
    const VectorXd velocity = direction(gradient, hessian, decrement_);
    if (decrement_ <= tolerance * barrier.weight) return Outcome::minimum;
    // Where two nearest places of a pair of arcs are about to become one the energy has small kinks, at which Newton's
    // method creeps; below the weight there is no more to gain than contact itself costs.
    const bool settled = decrement_ <= barrier.weight;
    creeping = settled ? creeping + 1 : 0;
    if (creeping > 10) return Outcome::minimum;
    if (iterations_ >= solver_.options_.maximumIterations) return Outcome::iterationLimit;
    ++iterations_;

    double step = largestStep(velocity, barrier.range);
    const double longest = step;
    const double path = step * relativePath(velocity, 2 * (barrier.range + pathLimit_));
    pairs_ = contact_.nearParts(state_, barrier.range + path);
    CellState next;
    for (const double shortest = 1e-10 * step;; step *= 0.5) {
      if (step < shortest) return settled ? Outcome::minimum : Outcome::noProgress;
      next = moved(state_, velocity, step);
      double nextGap = 0;
      const double trial = contact_.energy(next, pairs_, barrier, nullptr, nullptr, &nextGap) + objective(next);
      if (trial <= energy - 1e-4 * step * decrement_ && nextGap >= keptGap * gap) break;
    }
    if (step < 0.5 * longest)
      trust_ = std::max(0.25 * trust_, 1e-6 * pathLimit_);
    else if (step == longest)
      trust_ = std::min(2 * trust_, 0.25 * pathLimit_);
    state_ = next;
    if (travelled(state_.strain) >= drive_.farthest * (1 - 1e-12)) return Outcome::reached;
    if (isUnlimited()) return Outcome::unlimited;
  }
}

void EquilibriumSearch::measure(const CellContact::Barrier& barrier, CellEquilibrium& result) {
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

CellState EquilibriumSearch::relax() {
  minimize({1, solver_.radius_}, 1e-6);
  return state_;
}

CellEquilibrium EquilibriumSearch::run() {
  const EquilibriumOptions& options = solver_.options_;
  CellEquilibrium result;
  const double finalGap = options.finalGap * solver_.radius_;
  CellContact::Barrier barrier{pull() * options.firstGap * solver_.radius_ / solver_.latticeScale_, solver_.radius_};
  Outcome outcome = Outcome::minimum;
  double predicted = std::numeric_limits<double>::infinity();
  while (true) {
    const bool last = predicted <= finalGap;
    outcome = minimize(barrier, last ? 1e-4 : 0.1);
    measure(barrier, result);
    if (outcome != Outcome::minimum && outcome != Outcome::noProgress) break;
    if (last && (result.meanGap <= finalGap || outcome == Outcome::noProgress)) break;
    if (result.contacts.empty() && barrier.range <= options.rangeRatio * finalGap) break;
    // Force times gap is the weight near contact, so that gaps shrink as it does.
    const double gap = result.meanGap > 0 ? result.meanGap : barrier.range / options.rangeRatio;
    const double share = std::max(options.reduction, std::min(0.8 * finalGap / gap, 0.8));
    predicted = share * gap;
    barrier.weight *= share;
    barrier.range = std::clamp(options.rangeRatio * predicted, options.rangeRatio * finalGap, solver_.radius_);
    // What holds the cell pushes about as before. A contact that pushes far harder is not in balance: with the
    // stiffness of such a force Newton's method would only double its gap in a step, and creep along curved surfaces,
    // as methods that know the balanced forces (primal-dual ones) do not.
    double largest = 0;
    for (const CellContactForce& contact : result.contacts) largest = std::max(largest, contact.force);
    if (largest > 0) barrier.largestForce = 4 * largest;
    barrier.split = predicted > 0.03 * solver_.radius_ ? 1 : predicted > 3e-3 * solver_.radius_ ? 2 : 4;
  }
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
  return result;
}

}  // namespace pliant::interlock
