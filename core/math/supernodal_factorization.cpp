#include "core/math/supernodal_factorization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/dense_kernels.hpp"
#include "core/math/elimination_order.hpp"
#include "core/math/parallel.hpp"

namespace pliant::math {

namespace {

/// Supernodes with less work than this (about half a millisecond) are not worth spreading over threads.
constexpr double parallelWork = 2e7;
constexpr int panelRows = 256;  ///< of L, solved for by one thread

using Run = SupernodeTree::Run;

SupernodeTree chooseTree(const BlockPattern& pattern) {
  std::optional<SupernodeTree> best;
  for (const std::vector<int>& order : eliminationOrders(pattern)) {
    SupernodeTree candidate(pattern, order);
    if (!best || candidate.work < best->work) best = std::move(candidate);
  }
  return *std::move(best);
}

}  // namespace

bool SupernodalFactorization::suits(const BlockPattern& pattern) {
  return pattern.vertexCount() > 0 && pattern.firstColumn.back() >= 2 * pattern.vertexCount();
}

SupernodalFactorization::SupernodalFactorization(const Eigen::SparseMatrix<double>& matrix, const BlockPattern& pattern)
    : tree_(chooseTree(pattern)) {
  tree_.layOut(pattern, matrix);
  std::vector<int> parent;
  for (const Supernode& node : tree_.supernodes) parent.push_back(node.parent);
  traversal_.emplace(parent);
  size_ = static_cast<int>(matrix.cols());
  factors_.resize(tree_.factorSize);
  swaps_.resize(size_);
  statistics_.resize(tree_.supernodes.size());
}

double SupernodalFactorization::factorize(const double* values) {
  traversal_->childrenFirst(
      [&](int slotCount) {
        if (static_cast<int>(workspaces_.size()) < slotCount) workspaces_.resize(slotCount);
      },
      [&](int node) { eliminate(node, values); });
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;
  largestMultiplier_ = 0;
  determinantSign_ = 1;
  for (const PivotStatistics& statistics : statistics_) {
    if (!(statistics.smallest > 0)) return 0;
    smallest = std::min(smallest, statistics.smallest);
    largest = std::max(largest, statistics.largest);
    largestMultiplier_ = std::max(largestMultiplier_, statistics.largestMultiplier);
    determinantSign_ *= statistics.determinantSign;
  }
  return std::isfinite(largest) && std::isfinite(largestMultiplier_) ? smallest / largest : 0;
}

void SupernodalFactorization::eliminate(int index, const double* values) {
  const Supernode& node = tree_.supernodes[index];
  const int p = node.pivots;
  const int r = node.rows;
  const int m = node.size();
  double* l = lower(node);
  double* u = upper(node);
  int* swaps = swaps_.data() + node.firstPivot;
  const auto forEach = [&](int count, const auto& body) {
    if (node.work > parallelWork) {
      parallelFor(count, body);
    } else {
      for (int i = 0; i < count; ++i) body(i);
    }
  };
  const int* bounds = tree_.tileBounds.data() + node.tileBegin;
  const int tiles = node.tileEnd - node.tileBegin - 1;
  forEach(tiles, [&](int tile) { assembleTile(node, bounds[tile], bounds[tile + 1], values); });

  factorizeDense(p, l, m, swaps);

  const int upperTiles = static_cast<int>(std::count_if(bounds, bounds + tiles, [&](int begin) { return begin >= p; }));
  const int lowerTiles = (r + panelRows - 1) / panelRows;
  std::vector<double> multipliers(lowerTiles);
  forEach(upperTiles + lowerTiles, [&](int tile) {
    if (tile < upperTiles) {
      const int begin = bounds[tiles - upperTiles + tile];
      const int columns = bounds[tiles - upperTiles + tile + 1] - begin;
      double* x = u + Eigen::Index{begin - p} * p;
      exchangeRows(p, swaps, columns, x, p);
      solveTriangle(Triangle::unitLower, false, p, l, m, columns, x, p);
    } else {
      const int begin = (tile - upperTiles) * panelRows;
      const int rows = std::min(panelRows, r - begin);
      solveUpperFromRight(rows, p, l, m, l + p + begin, m);
      const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> x(
          l + p + begin, rows, p, Eigen::OuterStride<>(m));
      multipliers[tile - upperTiles] = x.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    }
  });

  PivotStatistics& statistics = statistics_[index];
  const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>> pivots(l, p, Eigen::InnerStride<>(m + 1));
  statistics.smallest = pivots.cwiseAbs().minCoeff<Eigen::PropagateNaN>();
  statistics.largest = pivots.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  statistics.largestMultiplier = 0;
  for (const double value : multipliers) {
    if (!(value <= statistics.largestMultiplier)) statistics.largestMultiplier = value;
  }
  bool negative = false;
  for (int i = 0; i < p; ++i) negative ^= (pivots[i] < 0) ^ (swaps[i] != i);
  statistics.determinantSign = negative ? -1 : 1;
}

void SupernodalFactorization::assembleTile(const Supernode& node, int begin, int end, const double* values) {
  // Columns of pivots hold the whole front's rows, the later ones only the rows of the pivots.
  const int p = node.pivots;
  const bool pivotColumns = begin < p;
  const int height = pivotColumns ? node.size() : p;
  double* tile = pivotColumns ? lower(node) + Eigen::Index{begin} * height : upper(node) + Eigen::Index{begin - p} * p;
  std::fill_n(tile, Eigen::Index{end - begin} * height, 0.0);

  const auto blocksEnd = tree_.entryBlocks.begin() + node.entryEnd;
  for (auto block = tree_.entryBlocks.begin() + node.entryBegin; block != blocksEnd && block->column < end; ++block) {
    const int last = std::min(end, block->column + block->columns);
    for (int j = std::max(begin, block->column); j < last; ++j) {
      std::copy_n(values + block->entry + Eigen::Index{j - block->column} * block->stride, block->rows,
                  tile + Eigen::Index{j - begin} * height + block->row);
    }
  }

  Eigen::VectorXd& workspace = workspaces_[TreeTraversal::slot()];
  if (workspace.size() < tree_.workspaceSize) workspace.resize(tree_.workspaceSize);
  for (int k = node.updateBegin; k < node.updateEnd; ++k) {
    const SupernodeTree::Update& update = tree_.updates[k];
    const Supernode& source = tree_.supernodes[update.source];
    const Run* runs = tree_.updateRuns.data() + update.runBegin;
    const Run* runsEnd = tree_.updateRuns.data() + update.runEnd;

    // The rows of the source whose columns fall into this tile are neighbours, as both are in ascending order.
    const Run* first =
        std::partition_point(runs, runsEnd, [&](const Run& run) { return run.target + run.length <= begin; });
    const Run* last = std::partition_point(first, runsEnd, [&](const Run& run) { return run.target < end; });
    if (first == last) continue;
    const int columnBegin = first->source + std::max(0, begin - first->target);
    const int columnEnd = (last - 1)->source + std::min((last - 1)->length, end - (last - 1)->target);
    const int columns = columnEnd - columnBegin;
    const int rows = pivotColumns ? source.rows - update.firstRow : update.pivotRows;

    multiply(rows, columns, source.pivots, lower(source) + source.pivots + update.firstRow, source.size(),
             upper(source) + Eigen::Index{columnBegin} * source.pivots, source.pivots, workspace.data(), rows);

    for (const Run* columnRun = first; columnRun != last; ++columnRun) {
      const int from = std::max(columnRun->source, columnBegin);
      const int to = std::min(columnRun->source + columnRun->length, columnEnd);
      for (int j = from; j < to; ++j) {
        const double* product = workspace.data() + Eigen::Index{j - columnBegin} * rows - update.firstRow;
        double* target = tile + Eigen::Index{columnRun->target + j - columnRun->source - begin} * height;
        for (const Run* run = runs; run != runsEnd; ++run) {
          const int length = std::min(run->length, update.firstRow + rows - run->source);
          if (length <= 0) break;
          for (int i = 0; i < length; ++i) target[run->target + i] -= product[run->source + i];
        }
      }
    }
  }
}

}  // namespace pliant::math
