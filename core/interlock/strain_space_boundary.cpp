#include "core/interlock/strain_space_boundary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

namespace {

using base::TerminationType;
using Eigen::Vector3d;

/// A neighbour is tried if it reaches farther than this, relative to the limit, and counts if it leads so much farther.
constexpr double tryAbove = 0.02, countAbove = 1e-3;
/// Where on its ray a neighbour's elements are brought before they are pulled, relative to the limit.
constexpr double enterAt = 0.8;
constexpr int mostRounds = 4;
/// Seconds between two calls of an observer, at least, and at least so many times what the last one took.
constexpr double observedEvery = 0.05, observedShare = 50;

EquilibriumOptions looserThan(EquilibriumOptions options) {
  options.finalGap = std::max(options.finalGap, 1e-2);
  return options;
}

class BoundaryComputation {
 public:
  BoundaryComputation(const CellSolver& solver, const BoundaryOptions& options, base::ExecutionContext& context,
                      BoundaryMemory* memory, const BoundaryObserver& observe)
      : solver_(solver),
        looser_(solver.contact().cell(), looserThan(solver.options())),
        options_(options),
        context_(context),
        memory_(memory),
        observe_(observe) {}

  StrainSpaceBoundary run() {
    findMiddle();
    boundary_.mesh = icosphere(options_.subdivisions);
    addStates();
    while (!context_.cancelRequested() && options_.tolerance > 0) {
      std::vector<std::array<int, 2>> edges;
      const double limit = options_.tolerance * boundary_.meanDistance();
      for (const auto& edge : edgesOf(boundary_.mesh))
        if (errorOf(edge) > limit) edges.push_back(edge);
      if (edges.empty() || boundary_.states.size() + edges.size() > static_cast<std::size_t>(options_.maximumStates))
        break;
      boundary_.mesh = refined(boundary_.mesh, edges);
      addStates();
    }
    finish();
    return std::move(boundary_);
  }

 private:
  /// The middle between the limits along each axis in turn.
  void findMiddle() {
    CellState state = solver_.perturbed(restState(solver_.contact().cell()), options_.perturbation, options_.seed);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d unit = Vector3d::Unit(axis);
      const CellEquilibrium up = solver_.solve(state, rayDrive(unit), &context_);
      const CellEquilibrium down = solver_.solve(state, rayDrive(-unit), &context_);
      const double shift = 0.5 * (up.state.strain[axis] + down.state.strain[axis]) - state.strain[axis];
      if (std::abs(shift) < 1e-9) continue;
      StrainDrive drive = rayDrive(shift > 0 ? unit : Vector3d(-unit));
      drive.farthest = std::abs(shift);
      state = solver_.relaxed(solver_.solve(state, drive, &context_).state);
    }
    boundary_.middleState = state;
    boundary_.middle = state.strain;
  }

  BoundaryState recalled(const std::string& name, const std::function<BoundaryState()>& compute) {
    BoundaryState state;
    if (memory_ && memory_->recall(name, state)) return state;
    state = compute();
    if (memory_ && state.termination != TerminationType::cancelled) memory_->keep(name, state);
    return state;
  }

  /// A state that is known now; an observer sees it soon. States are read elsewhere only while none is put.
  void put(int direction, BoundaryState state) {
    if (!observe_) {
      boundary_.states[direction] = std::move(state);
      return;
    }
    const std::lock_guard lock(observed_);
    boundary_.states[direction] = std::move(state);
    const double now = watch_.seconds();
    if (now < nextLook_) return;
    observe_(boundary_);
    nextLook_ = watch_.seconds() + std::max(observedEvery, observedShare * (watch_.seconds() - now));
  }

  BoundaryState stateOf(const CellEquilibrium& rest, const Vector3d& direction) const {
    BoundaryState state;
    state.distance = direction.dot(rest.state.strain - boundary_.middle);
    state.remaining = rest.remaining;
    state.meanGap = rest.meanGap;
    state.contacts = static_cast<int>(rest.contacts.size());
    state.iterations = rest.iterations;
    state.kind = rest.kind;
    state.termination = rest.termination;
    state.cell = rest.state;
    return state;
  }

  /// States of the directions that have none yet, then the test of their neighbourhood.
  void addStates() {
    const int first = static_cast<int>(boundary_.states.size());
    const int count = static_cast<int>(boundary_.mesh.directions.size()) - first;
    boundary_.states.resize(first + count);
    std::atomic<int> done{0};
    math::parallelFor(count, [&](int k) {
      const int i = first + k;
      if (context_.cancelRequested()) return;
      put(i, recalled("ray " + std::to_string(i), [&] {
            const Vector3d& direction = boundary_.mesh.directions[i];
            return stateOf(solver_.solve(boundary_.middleState, rayDrive(direction), &context_), direction);
          }));
      context_.reportProgress(0.6 * ++done / count);
    });
    for (int round = 0; options_.testStarShape && round < mostRounds; ++round)
      if (!testNeighbours(round)) break;
    measureErrors();
  }

  /// Tries each direction with the state of its farthest neighbour. All tries start from the states before, so that
  /// their order does not matter. False if nothing changed.
  bool testNeighbours(int round) {
    const std::vector<BoundaryState> before = boundary_.states;
    std::vector<int> farthest(before.size(), -1);
    const auto offer = [&](int i, int j) {
      if (farthest[i] < 0 || before[j].distance > before[farthest[i]].distance) farthest[i] = j;
    };
    for (const auto& [a, b] : edgesOf(boundary_.mesh)) offer(a, b), offer(b, a);
    // Of those that were tried before only neighbours that have changed since can lead to anything new.
    tried_.resize(before.size(), -1);
    std::atomic<bool> changed{false};
    math::parallelFor(static_cast<int>(before.size()), [&](int i) {
      const int j = farthest[i];
      if (context_.cancelRequested() || before[j].distance <= before[i].distance * (1 + tryAbove)) return;
      if (before[j].distance == tried_[i] || foldsAlike(before[i].cell, before[j].cell)) return;
      tried_[i] = before[j].distance;
      const std::string name = "test " + std::to_string(before.size()) + " " + std::to_string(round) + " ";
      put(i, recalled(
                 name + std::to_string(i), [&] { return tested(before[i], before[j], boundary_.mesh.directions[i]); }));
      if (boundary_.states[i].distance != before[i].distance) changed = true;
    });
    return changed;
  }

  /// Whether all elements are placed and turned nearly the same, as in states of one way to fold.
  bool foldsAlike(const CellState& first, const CellState& second) const {
    const double near = solver_.contact().cell().smallestRadius();
    for (std::size_t i = 0; i < first.rotations.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const double turn = Eigen::AngleAxisd(first.rotations[i].transpose() * second.rotations[i]).angle();
      const double reach = solver_.contact().partsOf(static_cast<int>(i)).reach();
      if ((first.positions.col(column) - second.positions.col(column)).norm() + turn * reach > near) return false;
    }
    return true;
  }

  BoundaryState tested(const BoundaryState& own, const BoundaryState& neighbour, const Vector3d& direction) const {
    if (own.kind == RestKind::unlimited || neighbour.kind == RestKind::unlimited) return own;
    const auto moveTo = [&](const CellState& from, const Vector3d& target, CellState& state) {
      const Vector3d path = target - from.strain;
      StrainDrive drive = rayDrive(path.normalized());
      drive.farthest = path.norm();
      const CellEquilibrium rest = looser_.solve(from, drive, &context_);
      state = rest.state;
      return rest.converged() && rest.kind == RestKind::reached;
    };
    CellState inside, middle;
    if (!moveTo(neighbour.cell, boundary_.middle + enterAt * own.distance * direction, inside)) return own;
    const CellEquilibrium beyond = looser_.solve(inside, rayDrive(direction), &context_);
    const double reached = direction.dot(beyond.state.strain - boundary_.middle);
    if (!beyond.converged() || reached <= own.distance * (1 + countAbove)) return own;
    BoundaryState result = own;
    // If it leads back to the middle as well, all of the ray is free.
    if (!moveTo(inside, boundary_.middle, middle)) {
      result.seesBeyond = true;
      return result;
    }
    const CellEquilibrium limit = solver_.solve(beyond.state, rayDrive(direction), &context_);
    if (!limit.converged()) return own;
    result = stateOf(limit, direction);
    result.iterations += own.iterations + beyond.iterations;
    result.raised = true;
    return result.distance > own.distance ? result : own;
  }

  /// How far each direction that cuts an edge is off that edge.
  void measureErrors() {
    errors_.assign(boundary_.states.size(), 0);
    generation_.assign(boundary_.states.size(), 0);
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      const auto& [a, b] = boundary_.mesh.parents[i];
      if (a < 0) continue;
      generation_[i] = 1 + std::max(generation_[a], generation_[b]);
      // The middle direction meets the chord between both points at the harmonic mean of their distances over the
      // cosine of half the angle between them.
      const double first = boundary_.states[a].distance, second = boundary_.states[b].distance;
      const double cosine = boundary_.mesh.directions[a].dot(boundary_.mesh.directions[i]);
      const double chord = 2 * first * second / (first + second) * cosine;
      errors_[i] = std::abs(boundary_.states[i].distance - chord);
    }
  }

  void finish() {
    boundary_.termination = TerminationType::converged;
    int failed = 0, unlimited = 0;
    for (const BoundaryState& state : boundary_.states) {
      failed += state.termination != TerminationType::converged;
      unlimited += state.termination == TerminationType::converged && state.kind == RestKind::unlimited;
    }
    const std::string all = " of " + std::to_string(boundary_.states.size()) + " directions";
    if (context_.cancelRequested()) {
      boundary_.termination = TerminationType::cancelled;
      boundary_.message = "the boundary was cancelled";
    } else if (failed > 0) {
      boundary_.termination = TerminationType::failed;
      boundary_.message = "contact did not settle in " + std::to_string(failed) + all;
    } else if (unlimited > 0) {
      boundary_.termination = TerminationType::infeasible;
      boundary_.message = "nothing limits " + std::to_string(unlimited) + all;
    }
    const auto edges = edgesOf(boundary_.mesh);
    for (const auto& edge : edges) {
      boundary_.largestError = std::max(boundary_.largestError, errorOf(edge));
      boundary_.meanError += errorOf(edge) / static_cast<double>(edges.size());
    }
    boundary_.largestError /= boundary_.meanDistance();
    boundary_.meanError /= boundary_.meanDistance();
  }

  /// Half of what its newer end was off the edge that it cut, since this one is half as long.
  double errorOf(const std::array<int, 2>& edge) const {
    const auto& [a, b] = edge;
    if (generation_[a] != generation_[b]) return 0.5 * errors_[generation_[a] > generation_[b] ? a : b];
    return 0.5 * std::max(errors_[a], errors_[b]);
  }

  const CellSolver& solver_;
  const CellSolver looser_;  ///< for tests, with larger gaps
  const BoundaryOptions& options_;
  base::ExecutionContext& context_;
  BoundaryMemory* memory_;
  const BoundaryObserver& observe_;
  std::mutex observed_;
  base::Stopwatch watch_;
  double nextLook_ = 0;  ///< of the observer, on the watch [s]
  StrainSpaceBoundary boundary_;
  std::vector<double> errors_;   ///< see measureErrors
  std::vector<int> generation_;  ///< of directions: how often the icosahedron was cut up to it
  std::vector<double> tried_;    ///< distance of the neighbour that each direction was tested with last
};

}  // namespace

double StrainSpaceBoundary::meanDistance() const {
  double sum = 0;
  for (const BoundaryState& state : states) sum += state.distance;
  return sum / static_cast<double>(states.size());
}

int StrainSpaceBoundary::count(bool BoundaryState::*flag) const {
  return static_cast<int>(std::count_if(states.begin(), states.end(), [&](const auto& state) { return state.*flag; }));
}

double StrainSpaceBoundary::largestGap() const {
  double largest = 0;
  for (const BoundaryState& state : states) largest = std::max(largest, state.meanGap);
  return largest;
}

bool StrainSpaceBoundary::isClosed() const {
  std::map<std::array<int, 2>, int> passes;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) ++passes[edge];
  for (const auto& [edge, count] : passes) {
    const auto back = passes.find({edge[1], edge[0]});
    if (count != 1 || back == passes.end() || back->second != 1) return false;
  }
  return termination == TerminationType::converged &&
         std::all_of(states.begin(), states.end(), [](const auto& state) { return state.distance > 0; });
}

double StrainSpaceBoundary::volume() const {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (strainAt(a) - middle).dot((strainAt(b) - middle).cross(strainAt(c) - middle)) / 6;
  return sum;
}

Vector3d greenStrain(const Vector3d& strain) {
  const Eigen::Matrix2d stretch = stretchOf(strain);
  const Eigen::Matrix2d green = 0.5 * (stretch * stretch - Eigen::Matrix2d::Identity());
  return {green(0, 0), green(1, 1), green(0, 1)};
}

StrainSpaceBoundary computeBoundary(const CellSolver& solver, const BoundaryOptions& options,
                                    base::ExecutionContext& context, BoundaryMemory* memory,
                                    const BoundaryObserver& observe) {
  return BoundaryComputation(solver, options, context, memory, observe).run();
}

}  // namespace pliant::interlock
