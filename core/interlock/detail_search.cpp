#include "core/interlock/detail_search.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/stopwatch.hpp"
#include "core/geometry/box_tree.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

using base::TerminationType;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Of the reach of an element: how far it moves in a step at most.
constexpr double farthestCarry = 2;
/// A step along the path leaves so much of each gap, or so much of the smallest radius.
constexpr double leftOfGap = 0.3, roomyGap = 0.05;
/// Rounds in which elements that jam are joined.
constexpr int mostJoinings = 50;
/// The most of them that may be, of all, in a step that could be halved; where it has been, by `shortStep`, all may.
constexpr double usuallyJammed = 0.3, shortStep = 1.0 / 8;

double angleOf(const Matrix3d& rotation) {
  const Vector3d axis(
      rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0), rotation(1, 0) - rotation(0, 1));
  return std::atan2(axis.norm(), rotation.trace() - 1);
}

}  // namespace

DetailSearch::DetailSearch(const SheetDetailer& detailer, const std::vector<Eigen::Matrix3Xd>& path)
    : detailer_(detailer),
      path_(path),
      radius_(detailer.radius_),
      range_(detailer.options_.range * detailer.radius_),
      reach_(0) {
  for (const ElementParts& parts : detailer.parts_) reach_ = std::max(reach_, parts.reach());
  targets_ = targetsAt(0);
  poses_.resize(targets_.size());
  awake_.assign(targets_.size(), 1);
  forElements(count(), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    poses_[index] = ElementPose(partsOf(i), targets_[index].position, targets_[index].rotation);
  });
}

std::size_t DetailSearch::shapeOf(int element) const {
  const PatchElement& own = detailer_.elements_[static_cast<std::size_t>(element)];
  return static_cast<std::size_t>(detailer_.cell_.elements[static_cast<std::size_t>(own.element)].shape);
}

std::vector<SheetShape::Frame> DetailSearch::targetsAt(double progress) const {
  const double at = progress * static_cast<double>(path_.size() - 1);
  const std::size_t from = std::min(static_cast<std::size_t>(at), path_.size() - 1),
                    to = std::min(from + 1, path_.size() - 1);
  const double share = at - static_cast<double>(from);
  const Eigen::Matrix3Xd positions = (1 - share) * path_[from] + share * path_[to];
  const std::vector<SheetShape::Map> maps = detailer_.shape_.nodeMaps(positions);
  std::vector<Frame> targets(detailer_.places_.size());
  forElements(static_cast<int>(targets.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    Frame frame = detailer_.shape_.frameAt(detailer_.places_[index], positions, maps);
    frame.position += detailer_.heights_[index] * frame.rotation.col(2);
    frame.rotation = frame.rotation * detailer_.turned_[index];
    targets[index] = frame;
  });
  return targets;
}

void DetailSearch::findPairs(double margin) {
  std::vector<geometry::BoxTree::Box> boxes;
  for (int i = 0; i < count(); ++i) {
    const Vector3d half = Vector3d::Constant(partsOf(i).reach() + margin + 0.5 * range_);
    const Vector3d& place = poses_[static_cast<std::size_t>(i)].position;
    boxes.emplace_back(place - half, place + half);
  }
  const auto near = [&](int a, int b) {
    const double farthest = partsOf(a).reach() + partsOf(b).reach() + 2 * margin + range_;
    return (poses_[static_cast<std::size_t>(a)].position - poses_[static_cast<std::size_t>(b)].position).squaredNorm() <
           farthest * farthest;
  };
  auto found = geometry::BoxTree(boxes).ownPairs(near);
  std::sort(found.begin(), found.end());
  pairs_.clear();
  for (const auto& [a, b] : found) pairs_.push_back({a, b, range_});
  forElements(static_cast<int>(pairs_.size()), [&](int k) {
    Pair& pair = pairs_[static_cast<std::size_t>(k)];
    pair.gap = gapBetweenElements(
        pair.a, poses_[static_cast<std::size_t>(pair.a)], pair.b, poses_[static_cast<std::size_t>(pair.b)], range_);
  });
  neighbours_.assign(poses_.size(), {});
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    neighbours_[static_cast<std::size_t>(pairs_[k].a)].push_back(static_cast<int>(k));
    neighbours_[static_cast<std::size_t>(pairs_[k].b)].push_back(static_cast<int>(k));
  }
}

double DetailSearch::gapBetweenElements(int a, const ElementPose& poseA, int b, const ElementPose& poseB,
                                        double reach) const {
  thread_local std::vector<std::array<int, 2>> near;
  near.clear();
  const Vector3d offset = poseA.position - poseB.position;
  appendNearParts(partsOf(a), poseA.centres, partsOf(b), poseB.centres, offset, reach, near);
  double smallest = reach;
  for (const auto& [first, second] : near) {
    const PlacedPart partA = poseA.part(partsOf(a), first), partB = poseB.part(partsOf(b), second);
    if (areApart(partA, partB, offset, partA.part->radius + partB.part->radius + smallest)) continue;
    smallest = std::min(smallest, gapBetween(partA, partB, offset));
  }
  return smallest;
}

double DetailSearch::relativeMove(int a, const ElementPose& nextA, int b, const ElementPose& nextB) const {
  const ElementPose &poseA = poses_[static_cast<std::size_t>(a)], &poseB = poses_[static_cast<std::size_t>(b)];
  const Vector3d before = poseB.rotation.transpose() * (poseA.position - poseB.position);
  const Vector3d after = nextB.rotation.transpose() * (nextA.position - nextB.position);
  const Matrix3d turn = nextB.rotation.transpose() * nextA.rotation * poseA.rotation.transpose() * poseB.rotation;
  return (after - before).norm() + angleOf(turn) * partsOf(a).reach();
}

bool DetailSearch::isAllowed(const Pair& pair, const std::vector<ElementPose>& next) const {
  const ElementPose &nextA = next[static_cast<std::size_t>(pair.a)], &nextB = next[static_cast<std::size_t>(pair.b)];
  const double moved = relativeMove(pair.a, nextA, pair.b, nextB);
  if (moved > pairMove * 2 * (radiusOf(pair.a) + radiusOf(pair.b))) return false;
  const double kept = std::min(leftOfGap * pair.gap, roomyGap * radius_);
  if (pair.gap - moved > kept) return true;
  return gapBetweenElements(pair.a, nextA, pair.b, nextB, range_) > kept;
}

bool DetailSearch::carry(const std::vector<Frame>& next, double mostJammed) {
  // How the sheet moves at each element: a turn, and a translation after it.
  std::vector<Matrix3d> turns(poses_.size());
  std::vector<Vector3d> shifts(poses_.size());
  std::vector<ElementPose> after(poses_.size());
  double farthest = 0;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    turns[i] = next[i].rotation * targets_[i].rotation.transpose();
    shifts[i] = next[i].position - turns[i] * targets_[i].position;
    farthest = std::max(farthest, (turns[i] * poses_[i].position + shifts[i] - poses_[i].position).norm() +
                                      angleOf(turns[i]) * partsOf(static_cast<int>(i)).reach());
  }
  if (!(farthest <= farthestCarry * reach_)) return false;
  findPairs(farthest);
  const auto place = [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(turns[index]) * Eigen::Quaterniond(poses_[index].rotation);
    after[index] = ElementPose(
        partsOf(i), turns[index] * poses_[index].position + shifts[index], turned.normalized().toRotationMatrix());
  };
  forElements(count(), place);
  std::vector<int> parent(poses_.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i)
      i = parent[static_cast<std::size_t>(i)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
    return i;
  };
  std::vector<char> changed(poses_.size(), 1), refused(pairs_.size(), 0);
  const std::vector<Matrix3d> ownTurns = turns;
  const std::vector<Vector3d> ownShifts = shifts;
  for (int round = 0; round < mostJoinings; ++round) {
    forElements(static_cast<int>(pairs_.size()), [&](int k) {
      const Pair& pair = pairs_[static_cast<std::size_t>(k)];
      if (!changed[static_cast<std::size_t>(pair.a)] && !changed[static_cast<std::size_t>(pair.b)]) return;
      refused[static_cast<std::size_t>(k)] = !isAllowed(pair, after);
    });
    bool any = false;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      if (refused[k]) {
        any = true;
        const int first = root(pairs_[k].a), second = root(pairs_[k].b);
        if (first == second) return false;  // already moved as one, and still: rounding, or gaps too small to tell
        parent[static_cast<std::size_t>(first)] = second;
        refused[k] = 0;
      }
    if (!any) {
      poses_ = std::move(after);
      return true;
    }
    std::vector<std::vector<int>> groups(poses_.size());
    for (int i = 0; i < count(); ++i) groups[static_cast<std::size_t>(root(i))].push_back(i);
    std::fill(changed.begin(), changed.end(), 0);
    long jammed = 0;
    for (const std::vector<int>& group : groups) {
      if (group.size() < 2) continue;
      jammed += static_cast<long>(group.size());
      // The mean turn about the mean place, which goes where it goes on the mean.
      Matrix3d sum = Matrix3d::Zero();
      Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
      for (const int i : group) {
        const auto index = static_cast<std::size_t>(i);
        sum += ownTurns[index];
        from += poses_[index].position / static_cast<double>(group.size());
        to += (ownTurns[index] * poses_[index].position + ownShifts[index]) / static_cast<double>(group.size());
      }
      const Eigen::JacobiSVD<Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
      if (turn.determinant() < 0) return false;
      for (const int i : group) {
        const auto index = static_cast<std::size_t>(i);
        turns[index] = turn;
        shifts[index] = to - turn * from;
        changed[index] = 1;
        if ((turn * poses_[index].position + shifts[index] - poses_[index].position).norm() +
                angleOf(turn) * partsOf(i).reach() >
            farthest)
          return false;  // farther than pairs were looked for
      }
    }
    if (static_cast<double>(jammed) > mostJammed * static_cast<double>(count())) return false;
    jams_ += jammed;
    forElements(count(), [&](int i) {
      if (changed[static_cast<std::size_t>(i)]) place(i);
    });
  }
  return false;
}

SheetDetail DetailSearch::run(base::ExecutionContext& context) {
  const base::Stopwatch watch;
  const DetailOptions& options = detailer_.options_;
  SheetDetail detail;
  detail.elements = detailer_.elements_;
  detail.leftOut = detailer_.leftOut_;
  const auto finish = [&](TerminationType termination, std::string message) {
    detail.termination = termination;
    detail.message = std::move(message);
    detail.jams = jams_;
    detail.seconds = watch.seconds();
    detail.pulls.resize(count());
    detail.turns.resize(count());
    detail.state.positions.resize(3, count());
    findPairs(0);
    detail.smallestGap = range_;
    for (const Pair& pair : pairs_) detail.smallestGap = std::min(detail.smallestGap, pair.gap);
    const std::vector<Frame> wanted = targetsAt(1);
    for (int i = 0; i < count(); ++i) {
      const auto index = static_cast<std::size_t>(i);
      detail.state.positions.col(i) = poses_[index].position;
      detail.state.rotations.push_back(poses_[index].rotation);
      detail.pulls[i] = (poses_[index].position - wanted[index].position).norm();
      detail.turns[i] = angleOf(poses_[index].rotation * wanted[index].rotation.transpose());
    }
    return detail;
  };
  findPairs(0);
  for (const Pair& pair : pairs_)
    if (!(pair.gap > 0)) return finish(TerminationType::infeasible, "Elements overlap where the path begins.");
  const double spacing = path_.size() > 1 ? 1.0 / static_cast<double>(path_.size() - 1) : 1;
  double step = spacing;
  while (detail.reached < 1) {
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "The placing of elements was cancelled.");
    const double next = std::min(1.0, detail.reached + step);
    std::vector<Frame> targets = targetsAt(next);
    if (!carry(targets, step <= shortStep * spacing ? 1 : usuallyJammed)) {
      step *= 0.5;
      if (step < options.smallestStep * spacing)
        return finish(TerminationType::failed, "Elements jam on the way, and no step is short enough.");
      continue;
    }
    targets_ = std::move(targets);
    std::fill(awake_.begin(), awake_.end(), 1);
    detail.reached = next;
    ++detail.steps;
    for (int i = 0; i < options.sweeps; ++i, ++detail.sweeps) detail.lastMove = sweep();
    step *= 1.5;
    context.reportProgress(0.9 * detail.reached);
  }
  for (int i = 0; i < options.finalSweeps; ++i) {
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "The placing of elements was cancelled.");
    detail.lastMove = sweep();
    ++detail.sweeps;
    context.reportProgress(0.9 + 0.1 * (i + 1) / options.finalSweeps);
    if (detail.lastMove <= options.tolerance * radius_) return finish(TerminationType::converged, "");
  }
  return finish(TerminationType::iterationLimit, "Elements still move after the last sweep.");
}

}  // namespace pliant::interlock
