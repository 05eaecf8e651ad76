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
      sheet_(problem_->sheet) {
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
  makeContact();
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

Eigen::Matrix3Xd ClothSimulation::bodyPointsAt(const ClothProblem& problem, double time) {
  Eigen::Index count = 0;
  for (const Body& body : problem.bodies) count += body.points.cols();
  Eigen::Matrix3Xd points(3, count);
  count = 0;
  for (const Body& body : problem.bodies) {
    points.middleCols(count, body.points.cols()) = placementAt(body.path, time).apply(body.points, body.centre);
    count += body.points.cols();
  }
  return points;
}

void ClothSimulation::makeContact() {
  if (problem_->bodies.empty() && !problem_->selfContact) return;
  const int nodes = problem_->model->nodeCount();
  mechanics::ContactGeometry geometry;
  geometry.selfContact = problem_->selfContact;
  for (const SheetTriangle& triangle : sheet_.triangles) geometry.triangles.push_back(triangle.nodes);
  geometry.radii.assign(static_cast<std::size_t>(nodes), 0);
  geometry.bodies.assign(static_cast<std::size_t>(nodes), 0);
  int first = nodes, number = 0;
  for (const Body& body : problem_->bodies) {
    const int count = static_cast<int>(body.points.cols());
    for (const auto& [a, b, c] : body.triangles) geometry.triangles.push_back({first + a, first + b, first + c});
    for (const auto& [a, b] : body.edges) geometry.edges.push_back({first + a, first + b});
    if (body.triangles.empty() && body.edges.empty())
      for (int i = 0; i < count; ++i) geometry.points.push_back(first + i);
    geometry.radii.insert(geometry.radii.end(), static_cast<std::size_t>(count), body.radius);
    geometry.bodies.insert(geometry.bodies.end(), static_cast<std::size_t>(count), ++number);
    first += count;
  }
  const double range = problem_->contactDistance;
  requirePositiveOption(range, "the contact distance");
  // Half-way into the range, where the barrier falls by 1.193 range a metre, a pair pushes ten times as hard as a node
  // weighs.
  const double gravity = 9.81;
  const double stiffness = 10 * sheet_.masses.mean() * gravity / (1.193 * range);
  Eigen::Matrix3Xd rest(3, first);
  rest << problem_->model->restPositions.reshaped(3, nodes), bodyPointsAt(*problem_, 0);
  contact_ = std::make_shared<mechanics::ContactBarrier>(
      std::move(geometry), rest, mechanics::ContactOptions{.range = range, .stiffness = stiffness, .separation = 0});
}

void ClothSimulation::requireFree() const {
  if (contact_) contact_->requireFree(withBodies(state_.positions, state_.time));
}

Eigen::Matrix3Xd ClothSimulation::withBodies(const Eigen::Matrix3Xd& positions, double time) const {
  const Eigen::Matrix3Xd bodies = bodyPointsAt(*problem_, time);
  Eigen::Matrix3Xd all(3, positions.cols() + bodies.cols());
  all << positions, bodies;
  return all;
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
    const Eigen::Matrix3Xd all = withBodies(state_.positions, state_.time);
    contact_->update(all);
    record.energies.contact = contact_->value();
    record.smallestGap = contact_->smallestGap(all);
  }
  if (!sheet_.limits.empty()) record.violation = std::max(0.0, stretchRatios(sheet_, state_.positions).maxCoeff() - 1);
  return record;
}

}  // namespace pliant::cloth
