#include "core/math/block_cholesky.hpp"

#include <algorithm>
#include <atomic>
#include <optional>

#include "core/math/front_kernels.hpp"
#include "core/math/parallel.hpp"

namespace pliant::math {

namespace {

/// Of one front: half the work of LU, slower in thin panels, and what assembling an update matrix and one more front
/// take. The constants are ratios of measured times.
double workOfFront(double p, double r) { return (p * p / 3 + p * r) * (p + 12) + r * r * (p + 8) + 3e3; }

/// target += source; both lie in different matrices.
inline void addRun(int length, const double* __restrict source, double* __restrict target) {
  for (int i = 0; i < length; ++i) target[i] += source[i];
}

constexpr int tasksWanted = 8;
constexpr double parallelFrontWork = 5e6;  ///< below which threads cost more than they save

SupernodeTree chooseFronts(const BlockPattern& pattern, OrderingEffort effort) {
  std::optional<SupernodeTree> best;
  for (const std::vector<int>& order : eliminationOrders(pattern, effort)) {
    SupernodeTree candidate(pattern, order, workOfFront);
    if (!best || candidate.work < best->work) best = std::move(candidate);
  }
  return *std::move(best);
}

}  // namespace

BlockCholesky::BlockCholesky(int vertexCount, const std::vector<std::array<int, 2>>& pairs, OrderingEffort effort)
    : vertexCount_(vertexCount), placeOf_(vertexCount), frontOfPlace_(vertexCount) {
  if (vertexCount == 0) return;
  const BlockPattern pattern(vertexCount, width, pairs);
  const SupernodeTree tree = chooseFronts(pattern, effort);
  for (int place = 0; place < vertexCount; ++place) placeOf_[tree.vertices()[place]] = place;
  const int count = static_cast<int>(tree.supernodes.size());
  Eigen::Index size = 0;
  std::vector<double> work;
  for (int f = 0; f < count; ++f) {
    const SupernodeTree::Supernode& node = tree.supernodes[f];
    Front& front = fronts_.emplace_back();
    front.pivots = node.pivots;
    front.rows = node.rows;
    front.parent = node.parent;
    front.firstPivot = node.firstPivot;
    front.stride = frontStride(node.size());
    front.panel = size;
    size += Eigen::Index{front.stride} * front.pivots;
    front.rowBegin = static_cast<int>(rowVertices_.size());
    rowVertices_.insert(rowVertices_.end(), tree.rowPlaces(f).begin(), tree.rowPlaces(f).end());
    std::fill(frontOfPlace_.begin() + tree.vertexBegin()[f], frontOfPlace_.begin() + tree.vertexBegin()[f + 1], f);
    const double p = node.pivots, r = node.rows;
    flops_ += p * p * p / 3 + p * p * r + p * r * r;
    work.push_back(node.work);
  }
  panels_.setZero(size + 2 * frontStride(0));
  inversePivots_.resize(vertexCount * width);

  std::vector<std::vector<int>> childrenOf(count);
  std::vector<int> local(vertexCount, -1);  // place -> vertex of the parent's front
  for (int f = 0; f < count; ++f) {
    Front& front = fronts_[f];
    if (front.parent < 0) continue;
    childrenOf[front.parent].push_back(f);
    const Front& parent = fronts_[front.parent];
    const int firstPlace = parent.firstPivot / width, pivotVertices = parent.pivots / width;
    for (int i = 0; i < pivotVertices; ++i) local[firstPlace + i] = i;
    for (int i = 0; i < parent.rows / width; ++i) local[rowVertices_[parent.rowBegin + i]] = pivotVertices + i;
    front.runBegin = static_cast<int>(runs_.size());
    for (int i = 0; i < front.rows / width; ++i) {
      const int target = local[rowVertices_[front.rowBegin + i]] * width;
      // A run never crosses the end of the parent's pivots, where another matrix begins.
      if (static_cast<int>(runs_.size()) > front.runBegin && runs_.back().target + runs_.back().length == target &&
          target != parent.pivots)
        runs_.back().length += width;
      else
        runs_.push_back({i * width, target, width});
    }
    front.runEnd = static_cast<int>(runs_.size());
  }
  for (int f = 0; f < count; ++f) {
    fronts_[f].childBegin = static_cast<int>(children_.size());
    children_.insert(children_.end(), childrenOf[f].begin(), childrenOf[f].end());
    fronts_[f].childEnd = static_cast<int>(children_.size());
  }
  for (int f = count - 1; f >= 0; --f)
    if (fronts_[f].parent >= 0) fronts_[f].side = 1 - fronts_[fronts_[f].parent].side;
  chooseTasks(work);
  sizeStacks();
}

/// Splits the tree from the top until no subtree has more than its share of the work.
void BlockCholesky::chooseTasks(const std::vector<double>& work) {
  const int count = static_cast<int>(fronts_.size());
  std::vector<double> subtree = work;
  for (int f = 0; f < count; ++f)
    if (fronts_[f].parent >= 0) subtree[fronts_[f].parent] += subtree[f];
  double total = 0;
  for (int f = 0; f < count; ++f)
    if (fronts_[f].parent < 0) total += subtree[f];
  const double share = total > parallelFrontWork ? total / tasksWanted : total + 1;
  for (int f = count - 1; f >= 0; --f) {
    const int parent = fronts_[f].parent;
    if (parent >= 0 && fronts_[parent].task >= 0) {
      fronts_[f].task = fronts_[parent].task;
    } else if (subtree[f] <= share) {
      fronts_[f].task = static_cast<int>(tasks_.size());
      tasks_.emplace_back();
    }
  }
  for (int f = 0; f < count; ++f) (fronts_[f].task < 0 ? top_ : tasks_[fronts_[f].task]).push_back(f);
}

void BlockCholesky::sizeStacks() {
  stacks_.resize(tasks_.size() + 1);
  updates_.resize(fronts_.size());
  const auto simulate = [&](const std::vector<int>& fronts, Stacks& stacks) {
    std::array<Eigen::Index, 2> top{0, 0}, highest{0, 0};
    for (const int f : fronts) {
      const Front& front = fronts_[f];
      top[front.side] += updateSize(front);
      highest[front.side] = std::max(highest[front.side], top[front.side]);
      for (int k = front.childBegin; k < front.childEnd; ++k)
        if (fronts_[children_[k]].task == front.task) top[1 - front.side] -= updateSize(fronts_[children_[k]]);
    }
    for (int side = 0; side < 2; ++side) stacks.memory[side].resize(highest[side]);
  };
  for (std::size_t t = 0; t < tasks_.size(); ++t) simulate(tasks_[t], stacks_[t]);
  simulate(top_, stacks_.back());
}

int BlockCholesky::updateStride(int rows) { return frontStride(rows); }

Eigen::Index BlockCholesky::updateSize(const Front& front) {
  return Eigen::Index{updateStride(front.rows)} * front.rows;
}

BlockCholesky::Place BlockCholesky::place(int row, int column) const {
  int later = placeOf_[row], earlier = placeOf_[column];
  const bool transposed = later < earlier;
  if (transposed) std::swap(later, earlier);
  const Front& front = fronts_[frontOfPlace_[earlier]];
  int at = later * width - front.firstPivot;
  if (frontOfPlace_[later] != frontOfPlace_[earlier]) {
    const auto begin = rowVertices_.begin() + front.rowBegin;
    at = front.pivots + width * static_cast<int>(std::lower_bound(begin, begin + front.rows / width, later) - begin);
  }
  const int from = earlier * width - front.firstPivot;
  return {front.panel + Eigen::Index{from} * front.stride + at, front.stride, transposed};
}

void BlockCholesky::clear() { panels_.setZero(); }

bool BlockCholesky::factorize() {
  std::atomic<bool> succeeded{true};
  const auto run = [&](const std::vector<int>& fronts, Stacks& stacks) {
    stacks.top = {0, 0};
    for (const int f : fronts) {
      if (!succeeded.load(std::memory_order_relaxed)) return;
      if (!eliminate(f, stacks)) succeeded = false;
    }
  };
  parallelFor(static_cast<int>(tasks_.size()), [&](int t) { run(tasks_[t], stacks_[t]); });
  run(top_, stacks_.back());
  return succeeded;
}

bool BlockCholesky::eliminate(int index, Stacks& stacks) {
  const Front& front = fronts_[index];
  const Eigen::Index size = updateSize(front);
  double* update = stacks.memory[front.side].data() + stacks.top[front.side];
  stacks.top[front.side] += size;
  updates_[index] = update;
  std::fill_n(update, size, 0.0);
  for (int k = front.childBegin; k < front.childEnd; ++k) {
    const Front& child = fronts_[children_[k]];
    addUpdate(child, updates_[children_[k]], front, update);
    if (child.task == front.task) stacks.top[child.side] -= updateSize(child);
  }
  double* panel = panels_.data() + front.panel;
  if (!factorizeFront(front.pivots, front.rows, panel, front.stride, inversePivots_.data() + front.firstPivot))
    return false;
  subtractOuterProduct(front.pivots, front.rows, panel + front.pivots, front.stride, update, updateStride(front.rows));
  return true;
}

void BlockCholesky::addUpdate(const Front& child, const double* update, const Front& parent, double* parentUpdate) {
  const int sourceStride = updateStride(child.rows), parentStride = updateStride(parent.rows);
  const Run* runs = runs_.data() + child.runBegin;
  const Run* end = runs_.data() + child.runEnd;
  for (const Run* columns = runs; columns != end; ++columns) {
    const bool isPivot = columns->target < parent.pivots;
    for (int c = 0; c < columns->length; ++c) {
      const int column = columns->target + c;
      const double* source = update + Eigen::Index{columns->source + c} * sourceStride;
      double* target = isPivot ? panels_.data() + parent.panel + Eigen::Index{column} * parent.stride
                               : parentUpdate + Eigen::Index{column - parent.pivots} * parentStride - parent.pivots;
      addRun(columns->length - c, source + columns->source + c, target + column);
      for (const Run* rows = columns + 1; rows != end; ++rows)
        addRun(rows->length, source + rows->source, target + rows->target);
    }
  }
}

void BlockCholesky::solve(Eigen::VectorXd& x) const {
  const int size = vertexCount_ * width;
  thread_local Eigen::VectorXd y, gathered;
  y.resize(size);
  gathered.resize(size + frontStride(0));
  for (int v = 0; v < vertexCount_; ++v) y.segment<width>(placeOf_[v] * width) = x.segment<width>(v * width);
  for (const Front& front : fronts_) {
    const double* panel = panels_.data() + front.panel;
    double* own = y.data() + front.firstPivot;
    solveFront(front.pivots, panel, front.stride, inversePivots_.data() + front.firstPivot, own);
    multiplyFront(front.pivots, front.rows, panel + front.pivots, front.stride, own, gathered.data());
    for (int i = 0; i < front.rows / width; ++i)
      y.segment<width>(rowVertices_[front.rowBegin + i] * width) -= gathered.segment<width>(i * width);
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const double* panel = panels_.data() + front->panel;
    double* own = y.data() + front->firstPivot;
    for (int i = 0; i < front->rows / width; ++i)
      gathered.segment<width>(i * width) = y.segment<width>(rowVertices_[front->rowBegin + i] * width);
    subtractTransposedFront(front->pivots, front->rows, panel + front->pivots, front->stride, gathered.data(), own);
    solveFrontTransposed(front->pivots, panel, front->stride, inversePivots_.data() + front->firstPivot, own);
  }
  for (int v = 0; v < vertexCount_; ++v) x.segment<width>(v * width) = y.segment<width>(placeOf_[v] * width);
}

}  // namespace pliant::math
