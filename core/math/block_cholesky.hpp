#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/math/elimination_order.hpp"
#include "core/math/supernode_tree.hpp"

namespace pliant::math {

/// L Lᵀ of a symmetric positive definite matrix of 3 x 3 blocks on the vertices of a graph, such as the stiffness of a
/// mesh. Multifrontal (Duff & Reid 1983), with relaxed supernodes in nested dissection order and vectorised kernels for
/// fronts of all sizes, because those of a surface mesh are mostly too small for a general library. The analysis is
/// done once; the matrix is then assembled straight into the factors, factorised there, and solved with. Disjoint
/// subtrees are spread over the threads; the result does not depend on how many there are.
class BlockCholesky {
 public:
  static constexpr int width = 3;

  /// `pairs`: vertices whose block is not zero, in any order.
  BlockCholesky(int vertexCount, const std::vector<std::array<int, 2>>& pairs,
                OrderingEffort effort = OrderingEffort::thorough);

  /// Where a block stands: entry (i, j) at values()[offset + j * stride + i], or, if `transposed`, (j, i) there. Of a
  /// diagonal block the entries with i >= j count.
  struct Place {
    Eigen::Index offset;
    int stride;
    bool transposed;
  };
  /// Of the block (row, column), or of its transpose (column, row), of which one is stored.
  Place place(int row, int column) const;

  /// Sets the matrix to 0.
  void clear();
  double* values() { return panels_.data(); }
  /// Turns the matrix into its factors. False if it is not positive definite to working precision or not finite.
  bool factorize();
  /// x = A⁻¹ x, size 3 vertexCount.
  void solve(Eigen::VectorXd& x) const;

  int vertexCount() const { return vertexCount_; }
  double factorEntries() const { return static_cast<double>(panels_.size()); }
  double flops() const { return flops_; }

 private:
  /// Neighbouring vertices of a child's rows that are neighbours in the parent's front as well; in scalars.
  struct Run {
    int source;
    int target;
    int length;
  };
  struct Front {
    int pivots = 0;  ///< p, scalars
    int rows = 0;    ///< r, scalars
    int stride = 0;  ///< of the panel
    int parent = -1;
    int firstPivot = 0;
    int runBegin = 0, runEnd = 0;  ///< into the parent's front
    int childBegin = 0, childEnd = 0;
    Eigen::Index panel = 0;  ///< p columns of p + r rows, the rest of each column is padding
    int rowBegin = 0;        ///< in rowVertices_, r / 3 of them
    int side = 0;            ///< parity of its depth: which of two stacks its update matrix lies on
    int task = -1;           ///< the subtree to which it belongs, -1: above all of them
  };
  struct Stacks {
    std::array<std::vector<double>, 2> memory;
    std::array<Eigen::Index, 2> top{0, 0};
  };

  void chooseTasks(const std::vector<double>& work);
  void sizeStacks();
  bool eliminate(int front, Stacks& stacks);
  void addUpdate(const Front& child, const double* update, const Front& parent, double* parentUpdate);
  static Eigen::Index updateSize(const Front& front);
  static int updateStride(int rows);

  int vertexCount_ = 0;
  double flops_ = 0;
  std::vector<Front> fronts_;  ///< children first
  std::vector<int> children_;
  std::vector<Run> runs_;
  std::vector<int> rowVertices_;  ///< places in the order of elimination
  std::vector<int> placeOf_;      ///< per vertex, in the order of elimination
  std::vector<int> frontOfPlace_;
  Eigen::VectorXd panels_;
  Eigen::VectorXd inversePivots_;
  std::vector<std::vector<int>> tasks_;  ///< fronts of each, children first
  std::vector<int> top_;                 ///< fronts of no task, children first
  std::vector<Stacks> stacks_;           ///< per task, and of the top
  std::vector<double*> updates_;         ///< per front, while it is needed
};

}  // namespace pliant::math
