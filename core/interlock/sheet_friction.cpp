#include "core/interlock/sheet_friction.hpp"

#include <algorithm>
#include <string>

namespace pliant::interlock {

namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using mechanics::Vector;

/// Contacts are looked at anew until friction changes by less than this, at most so often.
constexpr double lagTolerance = 1e-2;
constexpr int mostLags = 12;

constexpr int mostSheetIncrements = 600;
/// Moves shorter than this part of the longest lower the drag, by this factor.
constexpr double shortMove = 0.25;
constexpr double dragDecay = 0.25;
constexpr double dragGrowth = 2;
/// Below this part of the first drag there is none.
constexpr double leastDrag = 1e-3;

}  // namespace

SheetFrictionSolver::SheetFrictionSolver(solvers::EnergyMinimizer& minimizer,
                                         std::shared_ptr<mechanics::ContactBarrier> contact,
                                         const mechanics::FrictionOptions& options)
    : minimizer_(minimizer), contact_(std::move(contact)), options_(options) {}

std::shared_ptr<const mechanics::ContactFriction> SheetFrictionSolver::make(const Matrix3Xd& touching) const {
  return std::make_shared<const mechanics::ContactFriction>(*contact_, before_, touching, options_);
}

Matrix3Xd SheetFrictionSolver::forcesAt(const mechanics::ContactFriction& friction, const Matrix3Xd& all) const {
  Matrix3Xd forces = Matrix3Xd::Zero(3, all.cols());
  friction.addGradient(all, forces);
  return forces;
}

double SheetFrictionSolver::difference(const mechanics::ContactFriction& other, const Matrix3Xd& all) const {
  const double largest = std::max(current_->largestForce(), other.largestForce());
  if (largest == 0) return 0;
  return 0.5 * (forcesAt(other, all) - forcesAt(*current_, all)).colwise().norm().sum() / largest;
}

void SheetFrictionSolver::begin(const Matrix3Xd& all) {
  before_ = all;
  current_ = make(all);
  minimizer_.setFriction(current_);
}

double SheetFrictionSolver::renew(const Matrix3Xd& all) {
  const auto next = make(all);
  const double lag = difference(*next, all);
  current_ = next;
  minimizer_.setFriction(current_);
  return lag;
}

SheetFriction SheetFrictionSolver::judged(const Matrix3Xd& all) const {
  return {
      current_->contactCount(), current_->slidingShare(all), current_->dissipated(all), difference(*make(all), all)};
}

FrictionalRest::FrictionalRest(solvers::EnergyMinimizer& minimizer, std::shared_ptr<mechanics::ContactBarrier> contact,
                               Matrix3Xd bodyPoints, Eigen::VectorXd masses, double coefficient,
                               const FrictionalRestOptions& options)
    : minimizer_(minimizer),
      solver_(minimizer, std::move(contact), {coefficient, options.creep}),
      bodyPoints_(std::move(bodyPoints)),
      masses_(std::move(masses)),
      options_(options) {}

Matrix3Xd FrictionalRest::all(const Vector& x) const {
  Matrix3Xd places(3, x.size() / 3 + bodyPoints_.cols());
  places << x.reshaped(3, x.size() / 3), bodyPoints_;
  return places;
}

void FrictionalRest::adaptDrag(double moved, double firstDrag) {
  if (moved > options_.longest)
    drag_ = drag_ > 0 ? dragGrowth * drag_ : leastDrag * firstDrag;
  else if (moved < shortMove * options_.longest)
    drag_ *= dragDecay;
  if (drag_ < leastDrag * firstDrag) drag_ = 0;
}

base::SolverReport FrictionalRest::increment(Vector& x, const solvers::EnergyMinimizer::Surroundings& surroundings,
                                             const solvers::EnergyMinimizerOptions& options,
                                             base::ExecutionContext& context) {
  solvers::EnergyMinimizer::Surroundings dragged = surroundings;
  if (drag_ > 0) {
    dragged.inertia = drag_ * masses_.transpose().replicate(3, 1).reshaped();
    dragged.target = x;
  }
  solver_.begin(all(x));
  base::SolverReport report;
  std::vector<base::IterationRecord> records;
  for (int lag = 0; lag < mostLags; ++lag) {
    report = minimizer_.minimize(x, dragged, options, context);
    records.insert(records.end(), report.iterations.begin(), report.iterations.end());
    last_ = solver_.judged(all(x));
    if (!report.converged() || last_.lag <= lagTolerance) break;
    solver_.renew(all(x));
  }
  report.iterations = std::move(records);
  return report;
}

base::SolverReport FrictionalRest::settle(Vector& x, const solvers::EnergyMinimizer::Surroundings& surroundings,
                                          const solvers::EnergyMinimizerOptions& options,
                                          base::ExecutionContext& context) {
  const double force = surroundings.force.reshaped(3, masses_.size()).colwise().norm().sum();
  const double firstDrag = force / (masses_.sum() * options_.longest);
  if (drag_ < 0) drag_ = firstDrag;
  base::SolverReport report;
  std::vector<base::IterationRecord> records;
  for (int count = 0; count < mostSheetIncrements; ++count, ++increments_) {
    const Vector before = x;
    const bool isDragged = drag_ > 0;
    report = increment(x, surroundings, options, context);
    records.insert(records.end(), report.iterations.begin(), report.iterations.end());
    const double moved = (x - before).reshaped(3, masses_.size()).colwise().norm().maxCoeff();
    const bool rests = !isDragged && last_.slidingShare == 0 && moved <= options_.longest;
    if (!report.converged() || rests) break;
    adaptDrag(moved, firstDrag);
    if (count + 1 == mostSheetIncrements) {
      report.termination = base::TerminationType::iterationLimit;
      report.message = "The sheet still slides after " + std::to_string(mostSheetIncrements) + " increments.";
    }
  }
  report.iterations = std::move(records);
  return report;
}

}  // namespace pliant::interlock
