#include "core/cloth/incremental_potential.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"

namespace pliant::cloth {

using base::TerminationType;

namespace {

/// So many steps take the convex Hessian before the exact one is tried again.
constexpr int convexInSuccession = 4;
constexpr double farthestDescent = 64;  ///< times such a step
/// Of the mass term, where even the convex Hessian is not positive definite: at first, by how much it grows, and the
/// most.
constexpr double firstShift = 1e-3;
constexpr double shiftGrowth = 8;
constexpr double largestShift = 1e8;
/// Armijo's condition, and where the line search gives up.
constexpr double sufficientDecrease = 1e-4;
constexpr double smallestStep = 1e-10;
/// A Newton step shorter than this, relative to the size, is rounding.
constexpr double negligibleStep = 1e-14;
/// Decreases below this, relative to the energy, may drown in its rounding; below the second they do.
constexpr double drownedDecrease = 1e-10;
constexpr double roundingOfEnergy = 1e-14;
/// How far above the tolerance the residual may then be left.
constexpr double largestRounding = 100;

/// The same model with every coordinate free: which nodes are held changes from step to step.
std::shared_ptr<const mechanics::Model> withAllFree(const mechanics::Model& model) {
  auto copy = std::make_shared<mechanics::Model>(model);
  std::fill(copy->lockedCoordinates.begin(), copy->lockedCoordinates.end(), 0);
  copy->finish();
  return copy;
}

std::vector<std::array<int, 3>> sheetNodes(const LimitedSheet& sheet) {
  std::vector<std::array<int, 3>> triangles;
  for (const SheetTriangle& triangle : sheet.triangles) triangles.push_back(triangle.nodes);
  return triangles;
}

}  // namespace

IncrementalPotential::IncrementalPotential(std::shared_ptr<const ClothProblem> problem)
    : problem_(std::move(problem)), assembler_(withAllFree(*problem_->model)) {
  const mechanics::Model& model = *problem_->model;
  masses_ = model.massMatrix().diagonal();
  totalMass_ = masses_.sum() / 3;
  externalForce_ = model.externalForce(0);
  const auto points = model.restPositions.reshaped(3, model.nodeCount());
  size_ = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  if (problem_->wind) wind_.emplace(*problem_->wind, sheetNodes(problem_->sheet), assembler_);
  setHeld(lockedNodes(model));
}

void IncrementalPotential::setHeld(const std::vector<char>& held) {
  if (held == held_) return;
  held_ = held;
  free_.clear();
  std::vector<int> index(held_.size(), -1);
  for (std::size_t node = 0; node < held_.size(); ++node) {
    if (held_[node]) continue;
    index[node] = static_cast<int>(free_.size());
    free_.push_back(static_cast<int>(node));
  }
  cholesky_.reset();
  if (free_.empty()) return;
  const auto& rows = assembler_.rows();
  const auto& columns = assembler_.columns();
  const auto blockOf = [&](std::size_t s) -> std::array<int, 2> {
    return {index[static_cast<std::size_t>(rows[s] / 3)], index[static_cast<std::size_t>(columns[s] / 3)]};
  };
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t s = 0; s < rows.size(); ++s)
    if (const auto block = blockOf(s); block[0] > block[1] && block[1] >= 0 && rows[s] % 3 == 0 && columns[s] % 3 == 0)
      pairs.push_back(block);
  cholesky_.emplace(static_cast<int>(free_.size()), pairs);
  slots_.assign(rows.size(), -1);
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const auto [row, column] = blockOf(s);
    if (row < 0 || column < 0) continue;
    const auto place = cholesky_->place(row, column);
    const int i = rows[s] % 3, j = columns[s] % 3;
    slots_[s] = place.offset + (place.transposed ? i * place.stride + j : j * place.stride + i);
  }
  diagonals_.clear();
  for (int node = 0; node < static_cast<int>(free_.size()); ++node) {
    const auto place = cholesky_->place(node, node);
    diagonals_.push_back({place.offset, place.offset + place.stride + 1, place.offset + 2 * (place.stride + 1)});
  }
}

void IncrementalPotential::beginWind(const Eigen::Matrix3Xd& positions, double time) {
  if (wind_) wind_->begin(positions, time);
}

Vector IncrementalPotential::windForce() const {
  Vector result = Vector::Zero(masses_.size());
  if (wind_) wind_->addGradient(Vector::Zero(masses_.size()), -1, result);
  return result;
}

double IncrementalPotential::value(const Vector& x) const {
  const mechanics::Model& model = *problem_->model;
  const double rate = terms_.rate;
  double sum = 0.5 * rate * rate * (x - terms_.target).array().square().matrix().dot(masses_) - externalForce_.dot(x) +
               (1 + model.stiffnessDamping * rate) * assembler_.value(x);
  if (model.massDamping != 0)
    sum += 0.5 * model.massDamping * rate * (x - terms_.base).array().square().matrix().dot(masses_);
  if (model.stiffnessDamping != 0) sum -= model.stiffnessDamping * rate * terms_.history.dot(x);
  if (extraForce_.size() > 0) sum -= extraForce_.dot(x);
  if (wind_) sum += wind_->value(rate * (x - terms_.base)) / rate;
  return sum;
}

Vector IncrementalPotential::gradient(const Vector& x) const {
  const mechanics::Model& model = *problem_->model;
  const double rate = terms_.rate;
  Vector result = (1 + model.stiffnessDamping * rate) * assembler_.gradient(x) - externalForce_;
  result += rate * rate * masses_.cwiseProduct(x - terms_.target);
  if (model.massDamping != 0) result += model.massDamping * rate * masses_.cwiseProduct(x - terms_.base);
  if (model.stiffnessDamping != 0) result -= model.stiffnessDamping * rate * terms_.history;
  if (extraForce_.size() > 0) result -= extraForce_;
  if (wind_) wind_->addGradient(rate * (x - terms_.base), 1, result);
  for (std::size_t node = 0; node < held_.size(); ++node)
    if (held_[node]) result.segment<3>(3 * static_cast<Eigen::Index>(node)).setZero();
  return result;
}

void IncrementalPotential::evaluateHessian(const Vector& x, mechanics::HessianKind kind) {
  assembler_.hessianEntries(x, entries_, kind);
  entries_ *= 1 + problem_->model->stiffnessDamping * terms_.rate;
  if (wind_) wind_->addHessian(terms_.rate * (x - terms_.base), terms_.rate, entries_);
}

bool IncrementalPotential::factorize() {
  cholesky_->clear();
  double* values = cholesky_->values();
  for (std::size_t s = 0; s < slots_.size(); ++s)
    if (slots_[s] >= 0) values[slots_[s]] += entries_[static_cast<Eigen::Index>(s)];
  const double inertia = this->inertia();
  for (std::size_t i = 0; i < free_.size(); ++i)
    for (const Eigen::Index diagonal : diagonals_[i]) values[diagonal] += inertia * masses_[3 * free_[i]];
  return cholesky_->factorize();
}

double IncrementalPotential::residualOf(const Vector& gradient) const {
  double sum = 0;
  for (const int node : free_) sum += gradient.segment<3>(3 * node).squaredNorm() / masses_[3 * node];
  return std::sqrt(sum / totalMass_) / (terms_.rate * terms_.rate * size_);
}

bool IncrementalPotential::newtonStep(const Vector& x, const Vector& gradient, Vector& step) {
  Vector solution(3 * static_cast<Eigen::Index>(free_.size()));
  const auto descends = [&] {
    if (!factorize()) return false;
    for (std::size_t i = 0; i < free_.size(); ++i)
      solution.segment<3>(3 * static_cast<Eigen::Index>(i)) = -gradient.segment<3>(3 * free_[i]);
    cholesky_->solve(solution);
    step.setZero(x.size());
    for (std::size_t i = 0; i < free_.size(); ++i)
      step.segment<3>(3 * free_[i]) = solution.segment<3>(3 * static_cast<Eigen::Index>(i));
    return step.allFinite() && step.dot(gradient) < 0;
  };
  convex_ = convexSteps_ > 0;
  if (!convex_) {
    shift_ = 0;
    evaluateHessian(x, mechanics::HessianKind::exact);
    if (descends()) return true;
    convexSteps_ = convexInSuccession;
    convex_ = true;
  }
  --convexSteps_;
  evaluateHessian(x, mechanics::HessianKind::convex);
  // What was needed last time is needed again, as a rule, or a little less.
  for (shift_ = shift_ > firstShift ? shift_ / shiftGrowth : 0; shift_ <= largestShift;
       shift_ = std::max(firstShift, shift_ * shiftGrowth))
    if (descends()) return true;
  return false;
}

double IncrementalPotential::longestDescent(const Vector& x, const Vector& step, double energy) const {
  double fraction = 1, reached = value(x + step);
  while (reached < energy && fraction < farthestDescent) {
    const double farther = value(x + 2 * fraction * step);
    if (!(farther < reached)) break;
    reached = farther;
    fraction *= 2;
  }
  return fraction;
}

base::SolverReport IncrementalPotential::minimize(Vector& x, const NewtonOptions& options,
                                                  base::ExecutionContext& context) {
  const base::Stopwatch watch;
  base::SolverReport report;
  const auto finish = [&](TerminationType termination, const char* message) {
    report.termination = termination;
    report.message = message;
    report.seconds = watch.seconds();
    return report;
  };
  if (free_.empty()) return finish(TerminationType::converged, "");
  shift_ = 0;
  convexSteps_ = 0;
  double energy = value(x);
  Vector slope = gradient(x);
  double residual = residualOf(slope);
  report.iterations.push_back({0, residual, 0, 0});
  Vector step;
  for (int iteration = 1; iteration <= options.maximumIterations; ++iteration) {
    if (!std::isfinite(energy) || !std::isfinite(residual))
      return finish(TerminationType::failed, "The energy of the step is not finite.");
    if (residual <= options.tolerance) return finish(TerminationType::converged, "");
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "The step was cancelled.");
    if (!newtonStep(x, slope, step))
      return finish(TerminationType::failed, "No direction lowers the energy of the step.");
    const double length = step.lpNorm<Eigen::Infinity>() / size_;
    const double decrease = -slope.dot(step);
    double fraction = convex_ ? longestDescent(x, step, energy) : 1;
    for (;; fraction *= 0.5) {
      const Vector trial = x + fraction * step;
      const double trialEnergy = value(trial);
      const bool lower = trialEnergy <= energy - sufficientDecrease * fraction * decrease;
      // Near the end the decrease drowns in the rounding of the energy, and that of the force does not.
      const bool drowned = fraction == 1 && decrease <= drownedDecrease * std::abs(energy);
      if (lower || drowned) {
        Vector trialSlope = gradient(trial);
        const double trialResidual = residualOf(trialSlope);
        if (lower || trialResidual < residual) {
          x = trial;
          energy = trialEnergy;
          slope = std::move(trialSlope);
          residual = trialResidual;
          break;
        }
      }
      if (decrease <= roundingOfEnergy * std::abs(energy) && residual <= largestRounding * options.tolerance)
        return finish(TerminationType::converged, "");  // as near as rounding lets it come
      if (fraction < smallestStep)
        return finish(TerminationType::failed, "The line search of the step found no lower energy.");
    }
    report.iterations.push_back({iteration, residual, fraction, length});
    if (fraction == 1 && length <= negligibleStep) return finish(TerminationType::converged, "");
  }
  if (residual <= options.tolerance) return finish(TerminationType::converged, "");
  return finish(TerminationType::iterationLimit, "Newton's method did not end within its iterations.");
}

}  // namespace pliant::cloth
