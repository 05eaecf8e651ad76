#include "core/harmonic/newmark.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pliant::harmonic {

namespace {

/// A Newton iterate counts as converged when what it is still off by is below this fraction of the model's size.
constexpr double newtonTolerance = 1e-12;
/// Where rounding keeps corrections from shrinking, and they are below this, they are as good as none.
constexpr double largestRounding = 1e-9;
/// Factors are kept while each correction shrinks to less than this fraction of the one before.
constexpr double slowContraction = 0.3;
constexpr double smallestContraction = 1e-3;
constexpr int mostNewtonIterations = 40;

/// Derivative of a smooth function of τ by central differences of sixth order.
template <class Function>
Vector rateOf(const Function& function, double tau) {
  constexpr double step = 4e-3;
  const auto difference = [&](int i) -> Vector { return function(tau + i * step) - function(tau - i * step); };
  return (45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * step);
}

}  // namespace

NewmarkIntegration::NewmarkIntegration(const HarmonicBalanceProblem& problem, double omega, int steps)
    : model_(problem.model()),
      assembler_(problem.assembler()),
      omega_(omega),
      steps_(steps),
      duration_(2 * std::numbers::pi / (omega * steps)) {
  const auto& dofs = model_.dofs;
  const int freeCount = dofs.freeCount();
  std::vector<Eigen::Triplet<double>> rows, square;
  const SparseMatrix mass = model_.massMatrix();
  for (Eigen::Index column = 0; column < mass.cols(); ++column)
    for (SparseMatrix::InnerIterator it(mass, column); it; ++it) {
      const int row = dofs.freeIndex[it.row()];
      if (row < 0) continue;
      rows.emplace_back(row, static_cast<int>(column), it.value());
      if (dofs.freeIndex[column] >= 0) square.emplace_back(row, dofs.freeIndex[column], it.value());
    }
  mass_.resize(freeCount, mass.cols());
  mass_.setFromTriplets(rows.begin(), rows.end());

  const auto& lowerRows = assembler_.rows();
  const auto& lowerColumns = assembler_.columns();
  for (int s = 0; s < assembler_.entryCount(); ++s) {
    square.emplace_back(lowerRows[s], lowerColumns[s], 0.0);
    square.emplace_back(lowerColumns[s], lowerRows[s], 0.0);
  }
  for (int f = 0; f < freeCount; ++f) square.emplace_back(f, f, 0.0);
  jacobian_.resize(freeCount, freeCount);
  jacobian_.setFromTriplets(square.begin(), square.end());
  factors_.analyzePattern(jacobian_);
  massValues_ = Eigen::Map<const Vector>(jacobian_.valuePtr(), jacobian_.nonZeros());
  for (int s = 0; s < assembler_.entryCount(); ++s) {
    lower_.push_back(static_cast<int>(&jacobian_.coeffRef(lowerRows[s], lowerColumns[s]) - jacobian_.valuePtr()));
    upper_.push_back(static_cast<int>(&jacobian_.coeffRef(lowerColumns[s], lowerRows[s]) - jacobian_.valuePtr()));
  }

  for (int coordinate = 0; coordinate < model_.coordinateCount(); ++coordinate)
    if (dofs.freeIndex[coordinate] < 0) held_.push_back(coordinate);
  heldPositions_.resize(static_cast<Eigen::Index>(held_.size()), steps);
  heldVelocities_.resizeLike(heldPositions_);
  const Vector rest = model_.restPositions(dofs.freeCoordinates);
  const auto held = [&](double tau) -> Vector { return model_.configuration(rest, tau)(held_); };
  for (int i = 0; i < steps; ++i) {
    const double tau = 2 * std::numbers::pi * i / steps;
    heldPositions_.col(i) = held(tau);
    heldVelocities_.col(i) = omega * rateOf(held, tau);
  }
  past_.resize(model_.coordinateCount(), 3);
}

void NewmarkIntegration::setHeldCoordinates(State& state, int step) const {
  state.positions(held_) = heldPositions_.col(step);
  state.velocities(held_) = heldVelocities_.col(step);
}

void NewmarkIntegration::evaluateForce(State& state, int step) const {
  const auto& free = model_.dofs.freeCoordinates;
  state.gradient = assembler_.gradient(state.positions);
  state.force = (model_.externalForce(2 * std::numbers::pi * step / steps_) - state.gradient)(free);
  if (model_.massDamping != 0) state.force -= model_.massDamping * (mass_ * state.velocities);
}

void NewmarkIntegration::start(const Vector& positions, const Vector& velocities) {
  now_.positions = positions;
  now_.velocities = velocities;
  step_ = 0;
  setHeldCoordinates(now_, 0);
  evaluateForce(now_, 0);
  pastCount_ = 0;
  origin_ = now_.positions;
}

Vector NewmarkIntegration::defect(const State& next) const {
  const auto& free = model_.dofs.freeCoordinates;
  Vector result = mass_ * (next.velocities - now_.velocities) - 0.5 * duration_ * (now_.force + next.force);
  if (model_.stiffnessDamping != 0) result += model_.stiffnessDamping * (next.gradient - now_.gradient)(free);
  return result;
}

bool NewmarkIntegration::linearize(const Vector& positions) {
  assembler_.hessianEntries(positions, stiffness_);
  Eigen::Map<Vector> values(jacobian_.valuePtr(), jacobian_.nonZeros());
  values = (2 / duration_ + model_.massDamping) * massValues_;
  const double weight = model_.stiffnessDamping + 0.5 * duration_;
  const auto& rows = assembler_.rows();
  const auto& columns = assembler_.columns();
  for (Eigen::Index s = 0; s < stiffness_.size(); ++s) {
    values[lower_[static_cast<std::size_t>(s)]] += weight * stiffness_[s];
    if (rows[static_cast<std::size_t>(s)] != columns[static_cast<std::size_t>(s)])
      values[upper_[static_cast<std::size_t>(s)]] += weight * stiffness_[s];
  }
  ++factorizations_;
  contraction_ = 1;
  if (!values.allFinite()) return factorized_ = false;
  factors_.factorize(jacobian_);
  return factorized_ = factors_.info() == Eigen::Success;
}

bool NewmarkIntegration::solveStep(State& next, int step) {
  const auto& free = model_.dofs.freeCoordinates;
  double previous = 0;
  bool fresh = false;
  for (int iteration = 0; iteration < mostNewtonIterations; ++iteration) {
    next.velocities(free) = (2 / duration_ * (next.positions - now_.positions) - now_.velocities)(free);
    evaluateForce(next, step);
    const Vector residual = defect(next);
    if (!residual.allFinite()) return false;
    if (!factorized_ || (iteration > 0 && contraction_ > slowContraction)) {
      if (!linearize(next.positions)) return false;
      fresh = true;
    }
    const Vector change = factors_.solve(residual);
    ++newtonIterations_;
    next.positions(free) -= change;
    size_ = std::max(size_, (next.positions - origin_).lpNorm<Eigen::Infinity>());
    if (!change.allFinite()) return false;
    const double length = size_ > 0 ? change.lpNorm<Eigen::Infinity>() / size_ : 0;
    // The contraction is trusted from one step to the next, but one lucky correction is not.
    if (iteration > 0 && previous > 0) {
      const double measured = length / previous;
      contraction_ = contraction_ < 1 ? std::max(measured, 0.7 * contraction_) : std::min(measured, 1.0);
      contraction_ = std::max(contraction_, smallestContraction);
    }
    const double expected = contraction_ < 1 ? length * contraction_ / (1 - contraction_) : length;
    const bool stuckInRounding = iteration > 1 && fresh && length < largestRounding && contraction_ > 0.5;
    if (stuckInRounding) {
      roundingFloor_ = std::max(roundingFloor_, 2 * length);
      contraction_ = 0.5 * slowContraction;
    }
    // Soon after the start the motion may be smaller than the last digits of the positions allow to tell apart.
    const bool lastDigits = change.lpNorm<Eigen::Infinity>() <=
                            8 * std::numeric_limits<double>::epsilon() * next.positions.lpNorm<Eigen::Infinity>();
    if (expected <= newtonTolerance || length <= roundingFloor_ || lastDigits) {
      next.velocities(free) = (2 / duration_ * (next.positions - now_.positions) - now_.velocities)(free);
      evaluateForce(next, step);
      return true;
    }
    previous = length;
  }
  return false;
}

bool NewmarkIntegration::advance() {
  const int step = (step_ + 1) % steps_;
  State next = now_;
  const auto& free = model_.dofs.freeCoordinates;
  if (pastCount_ == 3)
    next.positions = 4 * now_.positions - 6 * past_.col(0) + 4 * past_.col(1) - past_.col(2);
  else
    next.positions(free) += duration_ * now_.velocities(free);
  setHeldCoordinates(next, step);
  if (!solveStep(next, step)) {
    // The prediction may have led astray: once more from where the model is.
    next = now_;
    setHeldCoordinates(next, step);
    factorized_ = false;
    if (!solveStep(next, step)) return false;
  }
  past_.col(2) = past_.col(1);
  past_.col(1) = past_.col(0);
  past_.col(0) = now_.positions;
  pastCount_ = std::min(pastCount_ + 1, 3);
  now_ = std::move(next);
  step_ = step;
  return true;
}

}  // namespace pliant::harmonic
