#include <algorithm>

#include "core/math/dense_kernels.hpp"
#include "core/math/parallel.hpp"
#include "core/math/supernodal_factorization.hpp"

namespace pliant::math {

namespace {

constexpr int chunkColumns = 16;  ///< right-hand sides solved together
/// Entries of the factors, times right-hand sides, below which threads cost more than they save.
constexpr double parallelEntries = 2e6;

using Run = SupernodeTree::Run;

}  // namespace

void SupernodalFactorization::solve(bool transposed, const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const {
  x.resize(b.rows(), b.cols());
  const int total = static_cast<int>(b.cols());
  parallelFor((total + chunkColumns - 1) / chunkColumns, [&](int chunk) {
    const int first = chunk * chunkColumns;
    const int columns = std::min(chunkColumns, total - first);
    Eigen::MatrixXd y(size_, columns);
    for (const Run& run : tree_.pivotRuns) {
      y.middleRows(run.target, run.length) = b.block(run.source, first, run.length, columns);
    }
    const auto forward = [&](int node) { solveForward(tree_.supernodes[node], transposed, columns, y.data()); };
    const auto backward = [&](int node) { solveBackward(tree_.supernodes[node], transposed, columns, y.data()); };
    if (static_cast<double>(tree_.factorSize) * columns < parallelEntries) {
      const int count = static_cast<int>(tree_.supernodes.size());
      for (int node = 0; node < count; ++node) forward(node);
      for (int node = count - 1; node >= 0; --node) backward(node);
    } else {
      traversal_->childrenFirst([](int) {}, forward);
      traversal_->parentsFirst(backward);
    }
    for (const Run& run : tree_.pivotRuns) {
      x.block(run.source, first, run.length, columns) = y.middleRows(run.target, run.length);
    }
  });
}

void SupernodalFactorization::solveForward(const Supernode& node, bool transposed, int columns, double* x) const {
  double* own = x + node.firstPivot;
  for (int k = node.updateBegin; k < node.updateEnd; ++k) {
    const SupernodeTree::Update& update = tree_.updates[k];
    const Supernode& source = tree_.supernodes[update.source];
    const int p = source.pivots;
    for (int r = update.runBegin; r < update.runEnd; ++r) {
      const Run& run = tree_.updateRuns[r];
      const int length = std::min(run.length, update.firstRow + update.pivotRows - run.source);
      if (length <= 0) break;
      if (transposed) {
        subtractProduct(true, p, length, upper(source) + Eigen::Index{run.source} * p, p, columns,
                        x + source.firstPivot, size_, own + run.target, size_);
      } else {
        subtractProduct(false, length, p, lower(source) + p + run.source, source.size(), columns, x + source.firstPivot,
                        size_, own + run.target, size_);
      }
    }
  }
  if (transposed) {
    solveTriangle(Triangle::upper, true, node.pivots, lower(node), node.size(), columns, own, size_);
  } else {
    exchangeRows(node.pivots, swaps_.data() + node.firstPivot, columns, own, size_);
    solveTriangle(Triangle::unitLower, false, node.pivots, lower(node), node.size(), columns, own, size_);
  }
}

void SupernodalFactorization::solveBackward(const Supernode& node, bool transposed, int columns, double* x) const {
  const int p = node.pivots;
  double* own = x + node.firstPivot;
  for (int r = node.rowRunBegin; r < node.rowRunEnd; ++r) {
    const Run& run = tree_.rowRuns[r];
    if (transposed) {
      subtractProduct(
          true, run.length, p, lower(node) + p + run.source, node.size(), columns, x + run.target, size_, own, size_);
    } else {
      subtractProduct(false, p, run.length, upper(node) + Eigen::Index{run.source} * p, p, columns, x + run.target,
                      size_, own, size_);
    }
  }
  if (transposed) {
    solveTriangle(Triangle::unitLower, true, p, lower(node), node.size(), columns, own, size_);
    exchangeRowsBack(p, swaps_.data() + node.firstPivot, columns, own, size_);
  } else {
    solveTriangle(Triangle::upper, false, p, lower(node), node.size(), columns, own, size_);
  }
}

}  // namespace pliant::math
