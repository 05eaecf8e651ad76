#include "core/interlock/macro_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/base/error.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Index;

/// Of the size of the sheet: by how much its weight stretches a grip.
constexpr double stretchOfGrip = 1e-5;
/// So often a body that was in the way of itself tries to move on within a step.
constexpr int mostAttempts = 20;
/// Where a step does not converge: the barriers that lead to its own, over it.
constexpr std::array<double, 3> largerBarriers = {100, 10, 1};

/// How fast contacts creep that hold: of the size of the sheet, in a second (as Li et al. 2020 choose it).
constexpr double creepRate = 1e-3;
/// Contacts are looked at anew in a step until friction changes by less than this, at most so often.
constexpr double lagOfStep = 0.05;
constexpr int mostLagsOfStep = 5;

void checkMotion(const MacroMotionOptions& options, const MacroLoads& loads, const std::vector<MacroGrip>& grips,
                 Index nodes) {
  const auto mustBe = [](bool right, const char* what) {
    if (!right) throw base::InputError("", what);
  };
  mustBe(options.timeStep > 0 && std::isfinite(options.timeStep), "The time step must be above 0.");
  mustBe(options.damping >= 0 && std::isfinite(options.damping), "The damping must not be negative.");
  mustBe(options.barrier > 0 && std::isfinite(options.barrier), "The barrier must be above 0.");
  std::set<int> held(loads.clamped.begin(), loads.clamped.end());
  for (const MacroGrip& grip : grips)
    for (const int node : grip.nodes) {
      if (node < 0 || node >= nodes)
        throw base::InputError("", "Node " + std::to_string(node) + " is gripped, but there is none.");
      if (!held.insert(node).second) throw base::InputError("", "Node " + std::to_string(node) + " is held twice.");
    }
}

/// Where the nodes of a grip are wanted (3 x nodes) [m].
Eigen::Matrix3Xd wantedAt(const MacroGrip& grip, const Vector& start, double time) {
  const Eigen::Matrix3Xd all = start.reshaped(3, start.size() / 3);
  const Eigen::Matrix3Xd places = all(Eigen::all, grip.nodes);
  return mechanics::placementAt(grip.path, time).apply(places, places.rowwise().mean());
}

bool holdsAt(const MacroGrip& grip, double time) { return !grip.release || time < *grip.release; }

}  // namespace

MacroMotion::MacroMotion(std::shared_ptr<const MacroSimulation> simulation, MacroLoads loads,
                         std::vector<MacroGrip> grips, const Vector& start, const MacroMotionOptions& options)
    : simulation_(std::move(simulation)),
      loads_(std::move(loads)),
      grips_(std::move(grips)),
      options_(options),
      start_(start),
      positions_(start),
      velocities_(Vector::Zero(start.size())),
      bodyPoints_(mechanics::bodyPointsAt(simulation_->contact_.bodies, 0)),
      minimizer_(simulation_->terms(), simulation_->held(loads_)) {
  const Index nodes = simulation_->masses_.size();
  checkMotion(options_, loads_, grips_, nodes);
  contact_ = simulation_->contactFrom(positions_, bodyPoints_);
  minimizer_.setContact(contact_, bodyPoints_);
  force_ = simulation_->surroundingsOf(loads_).force;
  const double forces = force_.reshaped(3, nodes).colwise().norm().sum(), size = simulation_->size();
  const double weight = std::max(forces, simulation_->masses_.sum());  // or that of an acceleration of 1 m/s²
  barrier_ = options_.barrier * weight * size / simulation_->areas_.sum();
  gripStiffness_ = weight / (stretchOfGrip * size);
  if (simulation_->limits_) minimizer_.setWeight(1, barrier_);
  if (contact_ && simulation_->contact_.friction > 0)
    rubbing_.emplace(minimizer_, contact_,
                     mechanics::FrictionOptions{simulation_->contact_.friction, creepRate * size * options_.timeStep});
}

MacroMotion::Surroundings MacroMotion::surroundingsOfStep() const {
  Surroundings surroundings;
  const double h = options_.timeStep, rate = 1 / (h * h), drag = options_.damping / h;
  const Vector masses = simulation_->masses_.transpose().replicate(3, 1).reshaped();
  surroundings.force = force_;
  surroundings.inertia = (rate + drag) * masses;
  surroundings.target = positions_ + rate / (rate + drag) * h * velocities_;
  for (const MacroGrip& grip : grips_) {
    if (!holdsAt(grip, time_ + h)) continue;
    const Eigen::Matrix3Xd wanted = wantedAt(grip, start_, time_ + h);
    for (std::size_t i = 0; i < grip.nodes.size(); ++i) {
      const Index first = 3 * Index{grip.nodes[i]};
      surroundings.inertia.segment<3>(first).setConstant(gripStiffness_);
      surroundings.target.segment<3>(first) = wanted.col(static_cast<Index>(i));
    }
  }
  return surroundings;
}

bool MacroMotion::moveBodies() {
  const Eigen::Matrix3Xd wanted = mechanics::bodyPointsAt(simulation_->contact_.bodies, time_ + options_.timeStep);
  if (!contact_ || wanted == bodyPoints_) return true;
  const Index nodes = positions_.size() / 3;
  Eigen::Matrix3Xd all(3, nodes + wanted.cols()), motion = Eigen::Matrix3Xd::Zero(3, all.cols());
  all << positions_.reshaped(3, nodes), bodyPoints_;
  motion.rightCols(wanted.cols()) = wanted - bodyPoints_;
  contact_->update(all);
  const double fraction = contact_->largestStep(all, motion);
  bodyPoints_ = fraction < 1 ? Eigen::Matrix3Xd(bodyPoints_ + fraction * motion.rightCols(wanted.cols())) : wanted;
  minimizer_.setContact(contact_, bodyPoints_);
  return fraction == 1;
}

base::SolverReport MacroMotion::minimize(const Surroundings& surroundings, base::ExecutionContext& context) {
  const solvers::EnergyMinimizerOptions options{
      .tolerance = options_.tolerance, .maximumIterations = options_.maximumIterations};
  const Vector start = positions_;
  base::SolverReport report = minimizer_.minimize(positions_, surroundings, options, context);
  if (report.converged() || report.termination == base::TerminationType::cancelled || !simulation_->limits_)
    return report;
  positions_ = start;
  for (const double factor : largerBarriers) {
    minimizer_.setWeight(1, factor * barrier_);
    const base::SolverReport next = minimizer_.minimize(positions_, surroundings, options, context);
    report.iterations.insert(report.iterations.end(), next.iterations.begin(), next.iterations.end());
    report.termination = next.termination;
    report.message = next.message;
  }
  return report;
}

MacroState MacroMotion::step(base::ExecutionContext& context) {
  const Surroundings surroundings = surroundingsOfStep();
  const Vector before = positions_;
  const Eigen::Matrix3Xd bodiesBefore = bodyPoints_;
  base::SolverReport report;
  std::vector<base::IterationRecord> records;
  SheetFriction friction;
  if (rubbing_) rubbing_->begin(simulation_->withBodies(positions_, bodyPoints_));
  for (int attempt = 0, lags = 0; attempt < mostAttempts; ++attempt) {
    const bool arrived = moveBodies();
    report = minimize(surroundings, context);
    records.insert(records.end(), report.iterations.begin(), report.iterations.end());
    if (!report.converged()) break;
    if (rubbing_) friction = rubbing_->judged(simulation_->withBodies(positions_, bodyPoints_));
    if (arrived && (friction.lag <= lagOfStep || ++lags == mostLagsOfStep)) break;
    if (rubbing_) rubbing_->renew(simulation_->withBodies(positions_, bodyPoints_));
  }
  report.iterations = std::move(records);
  if (!report.converged()) {
    positions_ = before;
    bodyPoints_ = bodiesBefore;
    minimizer_.setContact(contact_, bodyPoints_);
    MacroState state = judged();
    state.report = std::move(report);
    return state;
  }
  velocities_ = (positions_ - before) / options_.timeStep;
  friction_ = friction;
  dissipated_ += friction.dissipated;
  time_ += options_.timeStep;
  MacroState state = judged();
  state.report = std::move(report);
  return state;
}

MacroState MacroMotion::judged() const {
  MacroState state;
  state.positions = positions_;
  state.barrier = barrier_;
  simulation_->judge(state);
  state.work = force_.dot(positions_ - start_);
  state.friction = friction_;
  simulation_->judgeContact(state, contact_.get(), bodyPoints_, -loads_.gravity.stableNormalized());
  return state;
}

MacroEnergies MacroMotion::energies() const {
  MacroEnergies energies;
  const Vector masses = simulation_->masses_.transpose().replicate(3, 1).reshaped();
  energies.kinetic = 0.5 * velocities_.dot(masses.cwiseProduct(velocities_));
  energies.elastic = simulation_->elastic_->value(positions_);
  if (simulation_->limits_) energies.limits = barrier_ * simulation_->limits_->value(positions_);
  energies.potential = -force_.dot(positions_ - start_);
  energies.dissipated = dissipated_;
  if (contact_) {
    contact_->update(simulation_->withBodies(positions_, bodyPoints_));
    energies.contact = contact_->value();
  }
  return energies;
}

double MacroMotion::gripLag() const {
  double farthest = 0;
  for (const MacroGrip& grip : grips_) {
    if (!holdsAt(grip, time_)) continue;
    const Eigen::Matrix3Xd wanted = wantedAt(grip, start_, time_);
    for (std::size_t i = 0; i < grip.nodes.size(); ++i)
      farthest = std::max(
          farthest, (positions_.segment<3>(3 * Index{grip.nodes[i]}) - wanted.col(static_cast<Index>(i))).norm());
  }
  return farthest;
}

double MacroMotion::bodyLag() const {
  if (bodyPoints_.cols() == 0) return 0;
  return (mechanics::bodyPointsAt(simulation_->contact_.bodies, time_) - bodyPoints_).colwise().norm().maxCoeff();
}

}  // namespace pliant::interlock
