#include "core/cloth/cloth_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/cloth/step_attempt.hpp"

namespace pliant::cloth {

using base::InputError;

namespace {

void requirePositiveOption(double value, const char* what) {
  if (!(std::isfinite(value) && value > 0)) throw InputError("", std::string(what) + " must be a number above 0");
}

}  // namespace

bool keepsLimits(SteppingScheme scheme) {
  return scheme != SteppingScheme::implicitEuler && scheme != SteppingScheme::bdf2;
}

ClothSimulation::ClothSimulation(std::shared_ptr<const ClothProblem> problem, SteppingOptions options,
                                 LimiterFactory makeLimiter)
    : problem_((checkClothProblem(*problem), std::move(problem))),
      options_(std::move(options)),
      makeLimiter_(std::move(makeLimiter)),
      potential_(problem_),
      sheet_(problem_->sheet),
      contact_(makeContactBarrier(*problem_)) {
  if (contact_) checkContactOptions(options_.limitMethod, options_.norm);
  requirePositiveOption(options_.timeStep, "the time step");
  requirePositiveOption(options_.newton.tolerance, "the tolerance of Newton's method");
  if (!makeLimiter_)
    makeLimiter_ = [method = options_.limitMethod, projection = options_.projection](const SheetCones& cones) {
      return makeStrainLimiter(method, cones.constraints, projection);
    };
  sheet_.fixed.assign(static_cast<std::size_t>(problem_->model->nodeCount()), 2);  // unlike any state: made at first
  const auto rest = problem_->model->restPositions.reshaped(3, problem_->model->nodeCount());
  state_.positions = rest;
  state_.velocities.setZero(3, rest.cols());
  updateHeld();
  state_.positions = withPins(state_.positions.reshaped(), 0).reshaped(3, rest.cols());
  requireFree();
}

ClothSimulation::~ClothSimulation() = default;
ClothSimulation::ClothSimulation(ClothSimulation&&) noexcept = default;

void ClothSimulation::setState(double time, const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& velocities) {
  const Eigen::Index nodes = problem_->model->nodeCount();
  if (positions.cols() != nodes || velocities.cols() != nodes)
    throw InputError("", "a state needs the positions and velocities of all " + std::to_string(nodes) + " nodes");
  if (!positions.allFinite() || !velocities.allFinite() || !std::isfinite(time))
    throw InputError("", "a state needs finite positions and velocities");
  state_ = {time, positions, velocities, {}, {}};
  requireFree();
}

void ClothSimulation::setPinTarget(int node, const Eigen::Vector3d& position) {
  if (node < 0 || node >= problem_->model->nodeCount())
    throw InputError("", "there is no node " + std::to_string(node));
  if (!position.allFinite()) throw InputError("", "a node needs a finite place to go to");
  targets_[node] = position;
}

void ClothSimulation::releasePinTarget(int node) { targets_.erase(node); }

void ClothSimulation::requireFree() const {
  if (contact_) contact_->requireFree(withBodies(*problem_, state_.positions, state_.time));
}

void ClothSimulation::updateHeld() {
  std::vector<char> held = heldNodes(*problem_, state_.time + options_.timeStep);
  for (const auto& [node, position] : targets_) held[static_cast<std::size_t>(node)] = 1;
  if (held == sheet_.fixed) return;
  sheet_.fixed = held;
  potential_.setHeld(held);
  limiter_.reset();
  if (contact_) {
    LimitedSheet sheet = sheet_;
    if (!keepsLimits(options_.scheme) || options_.limitMethod == "none")
      for (SheetTriangle& triangle : sheet.triangles) triangle.limit = -1;
    contactProjection_ = std::make_unique<ContactProjection>(sheetCones(sheet, options_.norm).constraints, contact_);
  } else if (keepsLimits(options_.scheme) && options_.limitMethod != "none" && hasLimits(sheet_))
    limiter_ = makeLimiter_(sheetCones(sheet_, options_.norm));
}

Vector ClothSimulation::withPins(Vector positions, double fraction) const {
  Eigen::Matrix3Xd places = positions.reshaped(3, state_.positions.cols());
  placePins(*problem_, state_.time + fraction * options_.timeStep, places);
  positions = places.reshaped();
  for (const auto& [node, target] : targets_)
    positions.segment<3>(3 * node) = (1 - fraction) * state_.positions.col(node) + fraction * target;
  return positions;
}

StepTerms ClothSimulation::eulerTerms(const Vector& x, const Vector& v, double duration) const {
  StepTerms terms;
  terms.rate = 1 / duration;
  terms.base = x;
  terms.target = x + duration * v;
  if (problem_->model->stiffnessDamping != 0) terms.history = potential_.elasticForce(x);
  return terms;
}

StepTerms ClothSimulation::bdf2Terms(const Vector& x, const Vector& v, const Vector& earlierX, const Vector& earlierV,
                                     double duration) const {
  StepTerms terms;
  terms.rate = 1.5 / duration;
  terms.base = (4 * x - earlierX) / 3;
  terms.target = terms.base + (4 * v - earlierV) / (3 * terms.rate);
  if (problem_->model->stiffnessDamping != 0)
    terms.history = (4 * potential_.elasticForce(x) - potential_.elasticForce(earlierX)) / 3;
  return terms;
}

StepRecord ClothSimulation::step(base::ExecutionContext& context) {
  updateHeld();
  Attempt attempt(*this, context);
  const bool done =
      options_.scheme == SteppingScheme::stepAndReflect || options_.scheme == SteppingScheme::bdf2AndReflect
          ? stepReflected(attempt)
      : options_.scheme == SteppingScheme::secondOrderReflect ? stepSecondOrder(attempt)
                                                              : stepOnce(attempt);
  if (done) state_ = std::move(attempt.next);
  StepRecord& record = attempt.record;
  record.time = state_.time;
  record.energies = energies();
  if (contact_) {
    const Eigen::Matrix3Xd all = withBodies(*problem_, state_.positions, state_.time);
    contact_->update(all);
    record.energies.contact = contact_->value();
    record.smallestGap = contact_->smallestGap(all);
  }
  if (!sheet_.limits.empty()) record.violation = std::max(0.0, stretchRatios(sheet_, state_.positions).maxCoeff() - 1);
  return record;
}

}  // namespace pliant::cloth
