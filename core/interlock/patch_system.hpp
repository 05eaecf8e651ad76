#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <vector>

#include "core/math/block_cholesky.hpp"

namespace pliant::interlock {

/// The linear system of a Newton step of a finite patch: a sparse symmetric matrix of one 6 x 6 block an element and a
/// pair of elements that are near each other, bordered by a few dense columns (curvatures, which move all elements) and
/// by a few linear constraints,
///   [A + μ I, C, Bᵀ; Cᵀ, D + μ I, 0; B, 0, 0] [u; k; λ] = -[g; h; 0].
/// A is factorised by BlockCholesky, of which the analysis is kept as long as no new pairs are near; border and
/// constraints are eliminated by its Schur complement.
class PatchSystem {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  explicit PatchSystem(int elementCount) : count_(elementCount), diagonal_(elementCount) {}

  /// Sets all to 0. `pairs`: a < b, of which blocks may be added.
  void begin(const std::vector<std::array<int, 2>>& pairs, int borderCount);
  Matrix6& diagonal(int element) { return diagonal_[element]; }
  /// Rows of a, columns of b.
  Matrix6& pair(int a, int b) { return blocks_[indices_.at({a, b})]; }

  /// Calls visit(a, b, block) for all pairs.
  template <class Visit>
  void visitPairs(Visit&& visit) {
    for (const auto& [pair, index] : indices_) visit(pair[0], pair[1], blocks_[index]);
  }

  Eigen::VectorXd gradient;        ///< g
  Eigen::VectorXd borderGradient;  ///< h
  Eigen::MatrixXd border;          ///< C
  Eigen::MatrixXd corner;          ///< D
  Eigen::MatrixXd constraints;     ///< Bᵀ, a column each; of full rank

  /// False if the matrix is not positive definite on the constraints' null space for this shift μ (or not elsewhere
  /// either, which counts as well).
  bool solve(double shift, Eigen::VectorXd& step, Eigen::VectorXd& borderStep);

 private:
  bool factorize(double shift);
  void addBlock(int row, int column, const Eigen::Matrix3d& block);

  int count_;
  std::vector<Matrix6> diagonal_, blocks_;
  std::map<std::array<int, 2>, int> indices_;  ///< of pairs in blocks_
  std::unique_ptr<math::BlockCholesky> cholesky_;
};

}  // namespace pliant::interlock
