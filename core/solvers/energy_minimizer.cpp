#include "core/solvers/energy_minimizer.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"

namespace pliant::solvers {

using base::TerminationType;
using mechanics::HessianKind;
using mechanics::Vector;

namespace {

/// So many steps take the convex Hessian before the exact one is tried again.
constexpr int convexInSuccession = 4;
/// The convex Hessian is stiffer than the exact one: its steps are doubled up to this while that lowers the energy.
constexpr double farthestStep = 64;
/// Of the mean stiffness, where even the convex Hessian is not positive definite or leads nowhere: at first, by how
/// much it grows and falls, and the most.
constexpr double firstShift = 1e-6;
constexpr double shiftGrowth = 8;
constexpr double shiftDecay = 0.2;
constexpr double mostShift = 1e8;
/// Armijo's condition, and where the line search gives up.
constexpr double descentAsked = 1e-4;
constexpr double smallestStep = 1e-10;
/// Contacts are foreseen whose gap is by this part of the range above it.
constexpr double foresight = 0.3;
/// Decreases below this, relative to the energy, drown in rounding; then the residual decides.
constexpr double roundingOfEnergy = 1e-13;

/// Where block entries stand in the factors.
Eigen::Index slotOf(const math::BlockCholesky& cholesky, int vertexRow, int vertexColumn, int i, int j) {
  const math::BlockCholesky::Place place = cholesky.place(vertexRow, vertexColumn);
  return place.offset + (place.transposed ? Eigen::Index{i} * place.stride + j : Eigen::Index{j} * place.stride + i);
}

}  // namespace

EnergyMinimizer::EnergyMinimizer(std::vector<Term> terms, std::vector<char> heldNodes)
    : terms_(std::move(terms)), held_(std::move(heldNodes)), vertex_(held_.size(), -1), entries_(terms_.size()) {
  for (std::size_t node = 0; node < held_.size(); ++node) {
    if (held_[node]) continue;
    vertex_[node] = static_cast<int>(free_.size());
    free_.push_back(static_cast<int>(node));
  }
  for (const Term& term : terms_)
    for (int s = 0; s < term.energy->entryCount(); ++s) {
      const int row = term.energy->rows()[s], column = term.energy->columns()[s];
      if (row % 3 != 0 || column % 3 != 0 || row == column) continue;
      if (vertex_[row / 3] >= 0 && vertex_[column / 3] >= 0) pairs_.push_back({vertex_[row / 3], vertex_[column / 3]});
    }
  if (!free_.empty()) analyse();
}

void EnergyMinimizer::setContact(std::shared_ptr<mechanics::ContactBarrier> contact, Eigen::Matrix3Xd bodyPoints) {
  contact_ = std::move(contact);
  bodyPoints_ = std::move(bodyPoints);
}

void EnergyMinimizer::analyse() {
  contactPairs_.clear();
  if (contact_) {
    std::vector<std::array<int, 2>> couples = contact_->coupledNodes(foresight * contact_->options().range);
    if (friction_) {
      const std::vector<std::array<int, 2>> rubbing = friction_->coupledNodes();
      couples.insert(couples.end(), rubbing.begin(), rubbing.end());
    }
    for (const auto& [a, b] : couples) {
      const auto [q, p] = std::minmax(vertex_[a], vertex_[b]);
      if (q >= 0) contactPairs_.push_back({p, q});
    }
    std::sort(contactPairs_.begin(), contactPairs_.end());
    contactPairs_.erase(std::unique(contactPairs_.begin(), contactPairs_.end()), contactPairs_.end());
  }
  std::vector<std::array<int, 2>> pairs = pairs_;
  pairs.insert(pairs.end(), contactPairs_.begin(), contactPairs_.end());
  cholesky_.emplace(
      static_cast<int>(free_.size()), pairs, contact_ ? math::OrderingEffort::quick : math::OrderingEffort::thorough);
  slots_.clear();
  diagonals_.clear();
  for (const Term& term : terms_) {
    std::vector<Eigen::Index>& slots = slots_.emplace_back(static_cast<std::size_t>(term.energy->entryCount()), -1);
    for (int s = 0; s < term.energy->entryCount(); ++s) {
      const int row = term.energy->rows()[s], column = term.energy->columns()[s];
      if (vertex_[row / 3] >= 0 && vertex_[column / 3] >= 0)
        slots[s] = slotOf(*cholesky_, vertex_[row / 3], vertex_[column / 3], row % 3, column % 3);
    }
  }
  for (int v = 0; v < static_cast<int>(free_.size()); ++v)
    diagonals_.push_back(
        {slotOf(*cholesky_, v, v, 0, 0), slotOf(*cholesky_, v, v, 1, 1), slotOf(*cholesky_, v, v, 2, 2)});
}

bool EnergyMinimizer::hasRoomForContacts() const {
  return std::all_of(blocks_.begin(), blocks_.end(), [&](const mechanics::ContactBlock& block) {
    const auto [q, p] = std::minmax(vertex_[block.row], vertex_[block.column]);
    return q < 0 || p == q || std::binary_search(contactPairs_.begin(), contactPairs_.end(), std::array<int, 2>{p, q});
  });
}

Eigen::Matrix3Xd EnergyMinimizer::withBodies(const Vector& x) const {
  Eigen::Matrix3Xd all(3, x.size() / 3 + bodyPoints_.cols());
  all << x.reshaped(3, x.size() / 3), bodyPoints_;
  return all;
}

double EnergyMinimizer::freeFraction(const Vector& x, const Vector& step) const {
  if (!contact_) return 1;
  Eigen::Matrix3Xd motion = Eigen::Matrix3Xd::Zero(3, x.size() / 3 + bodyPoints_.cols());
  motion.leftCols(x.size() / 3) = step.reshaped(3, x.size() / 3);
  const Eigen::Matrix3Xd all = withBodies(x);
  contact_->update(all);
  return contact_->largestStep(all, motion);
}

double EnergyMinimizer::value(const Vector& x, const Surroundings& surroundings) const {
  double sum = -surroundings.force.dot(x);
  for (const Term& term : terms_) sum += term.weight * term.energy->value(x);
  if (surroundings.inertia.size() > 0)
    sum += 0.5 * (surroundings.inertia.array() * (x - surroundings.target).array().square()).sum();
  if (contact_) {
    const Eigen::Matrix3Xd all = withBodies(x);
    contact_->update(all);
    sum += contact_->value();
    if (friction_) sum += friction_->value(all);
  }
  return sum;
}

Vector EnergyMinimizer::gradient(const Vector& x, const Surroundings& surroundings, double* largest) const {
  Vector sum = -surroundings.force;
  if (largest) *largest = sum.cwiseAbs().maxCoeff();
  for (const Term& term : terms_) {
    const Vector own = term.weight * term.energy->gradient(x);
    if (largest) *largest = std::max(*largest, own.cwiseAbs().maxCoeff());
    sum += own;
  }
  if (surroundings.inertia.size() > 0) sum += surroundings.inertia.cwiseProduct(x - surroundings.target);
  if (contact_) {
    const Eigen::Matrix3Xd all = withBodies(x);
    Eigen::Matrix3Xd own = Eigen::Matrix3Xd::Zero(3, all.cols());
    contact_->update(all);
    contact_->addGradient(own);
    if (largest) *largest = std::max(*largest, own.cwiseAbs().maxCoeff());
    if (friction_) friction_->addGradient(all, own);
    sum += own.leftCols(x.size() / 3).reshaped();
  }
  for (std::size_t node = 0; node < held_.size(); ++node)
    if (held_[node]) sum.segment<3>(3 * static_cast<Eigen::Index>(node)).setZero();
  return sum;
}

bool EnergyMinimizer::factorizeAt(const Vector& x, const Surroundings& surroundings, mechanics::HessianKind kind,
                                  double shift) {
  for (std::size_t t = 0; t < terms_.size(); ++t) terms_[t].energy->hessianEntries(x, entries_[t], kind);
  if (contact_) {
    blocks_.clear();
    const Eigen::Matrix3Xd all = withBodies(x);
    contact_->update(all);
    contact_->addHessian(blocks_, kind == HessianKind::convex ? 1 : 0);
    if (friction_) friction_->addHessian(all, blocks_);
    if (!hasRoomForContacts()) analyse();
  }
  return factorize(surroundings, shift);
}

bool EnergyMinimizer::factorize(const Surroundings& surroundings, double shift) {
  cholesky_->clear();
  double* values = cholesky_->values();
  for (std::size_t t = 0; t < terms_.size(); ++t)
    for (Eigen::Index s = 0; s < entries_[t].size(); ++s)
      if (const Eigen::Index slot = slots_[t][static_cast<std::size_t>(s)]; slot >= 0)
        values[slot] += terms_[t].weight * entries_[t][s];
  for (const mechanics::ContactBlock& block : blocks_) {
    const int p = vertex_[block.row], q = vertex_[block.column];
    if (p < 0 || q < 0) continue;
    const math::BlockCholesky::Place place = cholesky_->place(p, q);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        values[place.offset + Eigen::Index{j} * place.stride + i] +=
            place.transposed ? block.entry(j, i) : block.entry(i, j);
  }
  double sum = 0;
  for (std::size_t v = 0; v < free_.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      double& diagonal = values[diagonals_[v][static_cast<std::size_t>(i)]];
      if (surroundings.inertia.size() > 0) diagonal += surroundings.inertia[3 * Eigen::Index{free_[v]} + i];
      sum += std::abs(diagonal);
    }
  if (shift > 0) {
    const double added = shift * sum / (3 * static_cast<double>(free_.size()));
    for (const auto& diagonal : diagonals_)
      for (const Eigen::Index place : diagonal) values[place] += added;
  }
  return cholesky_->factorize();
}

base::SolverReport EnergyMinimizer::minimize(Vector& x, const Surroundings& surroundings,
                                             const EnergyMinimizerOptions& options, base::ExecutionContext& context) {
  const base::Stopwatch watch;
  base::SolverReport report;
  const auto finish = [&](TerminationType termination, std::string message) {
    report.termination = termination;
    report.message = std::move(message);
    report.seconds = watch.seconds();
    return report;
  };
  if (free_.empty()) return finish(TerminationType::converged, "");
  double energy = value(x, surroundings), shift = 0;
  int convexSteps = 0;
  bool lengthened = false;
  const double size =
      (x.reshaped(3, x.size() / 3).rowwise().maxCoeff() - x.reshaped(3, x.size() / 3).rowwise().minCoeff()).norm();
  if (!std::isfinite(energy)) return finish(TerminationType::infeasible, "The start is outside what limits allow.");
  double scale = 0;
  Vector slope = gradient(x, surroundings, &scale), right(3 * static_cast<Eigen::Index>(free_.size())), step(x.size());
  for (int iteration = 0;; ++iteration) {
    const double residual = scale > 0 ? slope.cwiseAbs().maxCoeff() / scale : 0;
    report.iterations.push_back({iteration, residual, 0});
    if (options.visit) options.visit(x);
    if (residual <= options.tolerance) return finish(TerminationType::converged, "");
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "The equilibrium was cancelled.");
    if (iteration >= options.maximumIterations)
      return finish(TerminationType::iterationLimit, "No equilibrium in " + std::to_string(iteration) + " iterations.");
    bool convex = convexSteps > 0;
    if (!convex && !factorizeAt(x, surroundings, HessianKind::exact, 0)) {
      convexSteps = convexInSuccession;
      convex = true;
    }
    if (convex) {
      --convexSteps;
      for (bool regular = factorizeAt(x, surroundings, HessianKind::convex, shift); !regular;
           regular = factorize(surroundings, shift)) {
        shift = std::max(shiftGrowth * shift, firstShift);
        if (shift > mostShift) return finish(TerminationType::failed, "The stiffness is not finite.");
      }
    }
    for (std::size_t v = 0; v < free_.size(); ++v)
      right.segment<3>(3 * static_cast<Eigen::Index>(v)) = -slope.segment<3>(3 * Eigen::Index{free_[v]});
    cholesky_->solve(right);
    step.setZero();
    for (std::size_t v = 0; v < free_.size(); ++v)
      step.segment<3>(3 * Eigen::Index{free_[v]}) = right.segment<3>(3 * static_cast<Eigen::Index>(v));
    const double descent = slope.dot(step);
    double length = freeFraction(x, step), reached = value(x + length * step, surroundings);
    if (-descent < roundingOfEnergy * std::abs(energy)) {
      // The energy's decrease drowns in rounding, and the force's may not.
      const bool lower = std::isfinite(reached) && length == 1 &&
                         gradient(x + step, surroundings).cwiseAbs().maxCoeff() < slope.cwiseAbs().maxCoeff();
      if (!lower) {
        if (step.cwiseAbs().maxCoeff() <= options.stepTolerance * size) return finish(TerminationType::converged, "");
        return finish(TerminationType::failed, "Rounding leaves more force over than the tolerance allows.");
      }
    } else {
      while (!(reached <= energy + descentAsked * length * descent) && length > smallestStep) {
        length *= 0.5;
        reached = value(x + length * step, surroundings);
      }
      if (length <= smallestStep) {
        // Of an exact Hessian that is barely regular, or of a bad place: more of the diagonal.
        convexSteps = convexInSuccession;
        if (convex) shift = std::max(shiftGrowth * shift, firstShift);
        if (shift > mostShift) return finish(TerminationType::failed, "No direction lowers the energy.");
        continue;
      }
      // Not twice in succession: along stiff directions a doubled step only mirrors what is left.
      lengthened = convex && !lengthened && length == 1;
      while (lengthened && length < farthestStep) {
        const double farther = value(x + 2 * length * step, surroundings);
        if (!(farther < reached) || freeFraction(x, 2 * length * step) < 1) break;
        reached = farther;
        length *= 2;
      }
    }
    x += length * step;
    energy = reached;
    slope = gradient(x, surroundings, &scale);
    report.iterations.back().stepLength = length;
    if (convex) shift = shift > firstShift ? shiftDecay * shift : 0;
  }
}

}  // namespace pliant::solvers
