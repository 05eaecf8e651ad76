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
/// Rays that symmetries would make and that are computed to check them, and how far they may be off, relative to the
/// distance.
constexpr int checkedRays = 12;
constexpr double symmetricBelow = 1e-3;
/// Seconds between two calls of an observer, at least, and at least so many times what the last one took.
constexpr double observedEvery = 0.05, observedShare = 50;

std::vector<CellSymmetry> symmetriesFor(const BoundarySubject& subject, const BoundaryOptions& options) {
  std::vector<CellSymmetry> symmetries;
  if (options.useSymmetries) symmetries = subject.symmetries();
  if (symmetries.empty()) symmetries.push_back({Eigen::Matrix3d::Identity(), Vector3d::Zero(), {}});
  return symmetries;
}

/// Under which a limit straight from the middle is kept.
std::string rayName(int ray) { return "ray " + std::to_string(ray); }
std::string checkName(int ray) { return "check " + std::to_string(ray); }

class BoundaryComputation {
 public:
  BoundaryComputation(const BoundarySubject& subject, const BoundaryOptions& options, base::ExecutionContext& context,
                      BoundaryMemory* memory, const BoundaryObserver& observe)
      : subject_(subject),
        options_(options),
        context_(context),
        memory_(memory),
        symmetries_(symmetriesFor(subject, options)),
        observe_(observe) {}

  TerminationType runRays(const base::Shard& shard) {
    findMiddle();
    startMesh();
    checkSymmetries();
    boundary_.states.resize(boundary_.mesh.directions.size());
    addRays(0, shard, 1);
    return context_.cancelRequested() ? TerminationType::cancelled : TerminationType::converged;
  }

  std::vector<int> missingRays() {
    startMesh();
    BoundaryState state;
    for (const int ray : raysToCheck())
      for (const std::string& name : {checkName(ray), rayName(orbits_.representative[ray])})
        if (!memory_->recall(name, state)) return {orbits_.representative[ray]};
    checkSymmetries();
    std::vector<int> missing;
    for (int ray = 0; ray < static_cast<int>(members_.size()); ++ray)
      if (isComputed(ray) && !memory_->recall(rayName(ray), state)) missing.push_back(ray);
    return missing;
  }

  StrainSpaceBoundary run() {
    findMiddle();
    startMesh();
    checkSymmetries();
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
  /// The middle between the limits along each axis in turn. By symmetry it is 0 along the others.
  void findMiddle() {
    CellState state = subject_.start(options_.perturbation, options_.seed);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d unit = Vector3d::Unit(axis);
      if (std::any_of(symmetries_.begin(), symmetries_.end(), [&](const CellSymmetry& symmetry) {
            return !(symmetry.strainMap() * unit).isApprox(unit, 1e-9);
          }))
        continue;
      const CellEquilibrium up = subject_.solve(state, rayDrive(unit), false, &context_);
      const CellEquilibrium down = subject_.solve(state, rayDrive(-unit), false, &context_);
      const double shift = 0.5 * (up.state.strain[axis] + down.state.strain[axis]) - state.strain[axis];
      if (std::abs(shift) < 1e-9) continue;
      StrainDrive drive = rayDrive(shift > 0 ? unit : Vector3d(-unit));
      drive.farthest = std::abs(shift);
      state = subject_.relaxed(subject_.solve(state, drive, false, &context_).state);
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
  void put(int direction, const BoundaryState& state) {
    if (!observe_) {
      spread(direction, state);
      return;
    }
    const std::lock_guard lock(observed_);
    spread(direction, state);
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

  void startMesh() {
    boundary_.mesh = symmetricIcosphere(options_.subdivisions, symmetries_);
    findOrbits();
  }

  void findOrbits() {
    orbits_ = orbitsOf(boundary_.mesh, symmetries_);
    members_.assign(boundary_.mesh.directions.size(), {});
    for (std::size_t i = 0; i < members_.size(); ++i)
      members_[orbits_.representative[i]].push_back(static_cast<int>(i));
  }

  /// Symmetries make all others.
  bool isComputed(int direction) const { return !symmetric_ || orbits_.representative[direction] == direction; }

  /// The state of one direction as that of its representative, or the other way round.
  BoundaryState moved(BoundaryState state, const CellSymmetry& symmetry) const {
    if (!state.cell.rotations.empty()) state.cell = symmetry.mapped(subject_.contact().cell(), state.cell);
    return state;
  }
  const CellSymmetry& inverse(const CellSymmetry& symmetry) const {
    return *std::find_if(symmetries_.begin(), symmetries_.end(),
                         [&](const CellSymmetry& other) { return (other.linear * symmetry.linear).isIdentity(1e-6); });
  }

  /// The state of a direction and of all that symmetries make from it.
  void spread(int direction, const BoundaryState& state) {
    boundary_.states[direction] = state;
    if (!symmetric_) return;
    for (const int i : members_[direction])
      if (i != direction) boundary_.states[i] = moved(state, symmetries_[orbits_.symmetry[i]]);
  }

  /// Where symmetric directions have found different ways to fold, all of them get the farthest.
  void shareFarthest() {
    if (symmetric_) return;
    for (const std::vector<int>& members : members_) {
      const auto nearer = [&](int i, int j) { return boundary_.states[i].distance < boundary_.states[j].distance; };
      if (members.size() < 2) continue;
      const int farthest = *std::max_element(members.begin(), members.end(), nearer);
      const BoundaryState best = boundary_.states[farthest];
      if (best.termination != TerminationType::converged) continue;
      const BoundaryState original = moved(best, inverse(symmetries_[orbits_.symmetry[farthest]]));
      for (const int i : members) {
        if (boundary_.states[i].distance * (1 + countAbove) >= best.distance) continue;
        boundary_.states[i] = moved(original, symmetries_[orbits_.symmetry[i]]);
        boundary_.states[i].raised = true;
      }
    }
  }

  /// States of the directions that have none yet, then the test of their neighbourhood.
  void addStates() {
    const int first = static_cast<int>(boundary_.states.size());
    boundary_.states.resize(boundary_.mesh.directions.size());
    findOrbits();
    addRays(first, {}, 0.6);
    shareFarthest();
    for (int round = 0; options_.testStarShape && round < mostRounds; ++round) {
      if (!testNeighbours(round)) break;
      shareFarthest();
    }
    measureErrors();
  }

  BoundaryState straight(int ray) const {
    const Vector3d& direction = boundary_.mesh.directions[ray];
    return stateOf(subject_.solve(boundary_.middleState, rayDrive(direction), false, &context_), direction);
  }

  /// The limits straight from the middle, from ray `first` on.
  void addRays(int first, const base::Shard& shard, double progressAtEnd) {
    const int count = static_cast<int>(boundary_.states.size()) - first;
    std::atomic<int> done{0};
    math::parallelFor(count, [&](int k) {
      const int i = first + k;
      if (context_.cancelRequested()) return;
      if (isComputed(i) && shard.takes(i)) put(i, recalled(rayName(i), [&] { return straight(i); }));
      context_.reportProgress(progressAtEnd * ++done / count);
    });
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
      if (context_.cancelRequested() || !isComputed(i) || before[j].distance <= before[i].distance * (1 + tryAbove))
        return;
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
    const double near = subject_.contact().cell().smallestRadius();
    for (std::size_t i = 0; i < first.rotations.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const double turn = Eigen::AngleAxisd(first.rotations[i].transpose() * second.rotations[i]).angle();
      const double reach = subject_.contact().partsOf(static_cast<int>(i)).reach();
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
      const CellEquilibrium rest = subject_.solve(from, drive, true, &context_);
      state = rest.state;
      return rest.converged() && rest.kind == RestKind::reached;
    };
    CellState inside, middle;
    if (!moveTo(neighbour.cell, boundary_.middle + enterAt * own.distance * direction, inside)) return own;
    const CellEquilibrium beyond = subject_.solve(inside, rayDrive(direction), true, &context_);
    const double reached = direction.dot(beyond.state.strain - boundary_.middle);
    if (!beyond.converged() || reached <= own.distance * (1 + countAbove)) return own;
    BoundaryState result = own;
    // If it leads back to the middle as well, all of the ray is free.
    if (!moveTo(inside, boundary_.middle, middle)) {
      result.seesBeyond = true;
      return result;
    }
    const CellEquilibrium limit = subject_.solve(beyond.state, rayDrive(direction), false, &context_);
    if (!limit.converged()) return own;
    result = stateOf(limit, direction);
    result.iterations += own.iterations + beyond.iterations;
    result.raised = true;
    return result.distance > own.distance ? result : own;
  }

  std::vector<int> raysToCheck() const {
    std::vector<int> made, some;
    for (int i = 0; i < static_cast<int>(members_.size()); ++i)
      if (orbits_.representative[i] != i) made.push_back(i);
    const std::size_t count = std::min<std::size_t>(checkedRays, made.size());
    for (std::size_t k = 0; k < count; ++k) some.push_back(made[made.size() * k / count]);
    return some;
  }

  /// Compares some of the rays that symmetries make with those that they are made of. Where these find different ways
  /// to fold, all rays are computed.
  void checkSymmetries() {
    const std::vector<int> rays = raysToCheck();
    std::vector<double> differences(rays.size());
    math::parallelFor(static_cast<int>(rays.size()), [&](int k) {
      if (context_.cancelRequested()) return;
      const int original = orbits_.representative[rays[k]];
      const BoundaryState checked = recalled(checkName(rays[k]), [&] { return straight(rays[k]); });
      const double distance = recalled(rayName(original), [&] { return straight(original); }).distance;
      differences[k] = std::abs(checked.distance - distance) / std::max(checked.distance, distance);
    });
    boundary_.checkedRays = static_cast<int>(rays.size());
    for (const double difference : differences)
      boundary_.symmetryDifference = std::max(boundary_.symmetryDifference, difference);
    symmetric_ = boundary_.symmetryDifference < symmetricBelow;
    std::vector<Eigen::Matrix3d> maps;
    for (const CellSymmetry& symmetry : symmetries_) {
      const Eigen::Matrix3d map = symmetry.strainMap();
      if (std::none_of(maps.begin(), maps.end(), [&](const auto& other) { return map.isApprox(other, 1e-9); }))
        maps.push_back(map);
    }
    boundary_.symmetries = static_cast<int>(maps.size());
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
    boundary_.computedRays = symmetric_ ? orbits_.count : static_cast<int>(members_.size());
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

  const BoundarySubject& subject_;
  const BoundaryOptions& options_;
  base::ExecutionContext& context_;
  BoundaryMemory* memory_;
  const std::vector<CellSymmetry> symmetries_;  ///< the identity is the first
  DirectionOrbits orbits_;
  std::vector<std::vector<int>> members_;  ///< of the orbit of each representative
  bool symmetric_ = true;                  ///< whether limits are as symmetric as the cell
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

StretchedCell::StretchedCell(const CellSolver& solver)
    : solver_(solver), looser_(solver.contact().cell(), withLooserGaps(solver.options())) {}

CellState StretchedCell::start(double perturbation, unsigned seed) const {
  return solver_.perturbed(restState(contact().cell()), perturbation, seed);
}

CellEquilibrium StretchedCell::solve(const CellState& start, const StrainDrive& drive, bool loosely,
                                     const base::ExecutionContext* context) const {
  return (loosely ? looser_ : solver_).solve(start, drive, context);
}

StrainSpaceBoundary computeBoundary(const CellSolver& solver, const BoundaryOptions& options,
                                    base::ExecutionContext& context, BoundaryMemory* memory,
                                    const BoundaryObserver& observe) {
  return BoundaryComputation(StretchedCell(solver), options, context, memory, observe).run();
}

StrainSpaceBoundary computeBoundary(const BoundarySubject& subject, const BoundaryOptions& options,
                                    base::ExecutionContext& context, BoundaryMemory* memory,
                                    const BoundaryObserver& observe) {
  return BoundaryComputation(subject, options, context, memory, observe).run();
}

TerminationType computeRays(const BoundarySubject& subject, const BoundaryOptions& options, const base::Shard& shard,
                            base::ExecutionContext& context, BoundaryMemory& memory) {
  return BoundaryComputation(subject, options, context, &memory, {}).runRays(shard);
}

std::vector<int> missingRays(const BoundarySubject& subject, const BoundaryOptions& options, BoundaryMemory& memory) {
  base::ExecutionContext context;
  return BoundaryComputation(subject, options, context, &memory, {}).missingRays();
}

}  // namespace pliant::interlock
