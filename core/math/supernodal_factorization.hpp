#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "core/math/supernode_tree.hpp"
#include "core/math/tree_traversal.hpp"

namespace pliant::math {

/// LU of a sparse matrix made of dense blocks, in dense panels with LAPACK's kernels: see SupernodeTree for the method.
/// Rows are exchanged within a supernode's pivots only (partial pivoting), so the structure never changes; what that
/// costs in accuracy is measured by `largestMultiplier` and undone by refinement. Supernodes of disjoint subtrees, and
/// the tiles of large ones, are spread over the threads; sums run in a fixed order, so the factors do not depend on it.
/// Memory is kept for the next factorisation.
class SupernodalFactorization {
 public:
  /// Whether it is expected to be faster than a general method.
  static bool suits(const BlockPattern& pattern);
  /// Chooses an order and lays the factors out. `pattern` is that of `matrix`.
  SupernodalFactorization(const Eigen::SparseMatrix<double>& matrix, const BlockPattern& pattern);

  /// The smallest pivot over the largest, 0 if one vanishes. `values`: of a matrix with the analysed pattern.
  double factorize(const double* values);
  /// The largest entry of L below the pivot blocks: errors of the solution may grow by as much.
  double largestMultiplier() const { return largestMultiplier_; }

  /// x = A⁻¹ b, or A⁻ᵀ b, without refinement; n x m.
  void solve(bool transposed, const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const;

  int determinantSign() const { return determinantSign_; }
  double factorEntries() const { return static_cast<double>(tree_.factorSize); }
  double flops() const { return tree_.flops; }

 private:
  using Supernode = SupernodeTree::Supernode;

  struct PivotStatistics {
    double smallest = 0;
    double largest = 0;
    double largestMultiplier = 0;
    int determinantSign = 0;
  };

  void eliminate(int index, const double* values);
  void assembleTile(const Supernode& node, int begin, int end, const double* values);
  void solveForward(const Supernode& node, bool transposed, int columns, double* x) const;
  void solveBackward(const Supernode& node, bool transposed, int columns, double* x) const;
  double* lower(const Supernode& node) { return factors_.data() + node.lower; }
  double* upper(const Supernode& node) { return factors_.data() + node.upper; }
  const double* lower(const Supernode& node) const { return factors_.data() + node.lower; }
  const double* upper(const Supernode& node) const { return factors_.data() + node.upper; }

  SupernodeTree tree_;
  std::optional<TreeTraversal> traversal_;
  int size_ = 0;
  Eigen::VectorXd factors_;
  std::vector<int> swaps_;                   ///< per pivot, counted from the supernode's first
  std::vector<Eigen::VectorXd> workspaces_;  ///< per slot of the traversal
  std::vector<PivotStatistics> statistics_;  ///< per supernode
  double largestMultiplier_ = 0;
  int determinantSign_ = 0;
};

}  // namespace pliant::math
