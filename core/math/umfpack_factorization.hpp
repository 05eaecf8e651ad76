#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace pliant::math {

/// LU of any sparse matrix by UMFPACK (Davis 2004), with its symmetric strategy: columns are ordered by AMD on A + Aᵀ
/// and diagonal pivots are preferred. Holds no global state, so objects may be used from several threads at once.
class UmfpackFactorization {
 public:
  /// Orders the columns of a compressed matrix with at least one entry.
  explicit UmfpackFactorization(const Eigen::SparseMatrix<double>& matrix);
  /// The smallest pivot over the largest, of the matrix with scaled rows; 0 if it is singular. Same pattern as
  /// analysed.
  double factorize(const Eigen::SparseMatrix<double>& matrix);
  /// x = A⁻¹ b, or A⁻ᵀ b, without refinement.
  void solve(const Eigen::SparseMatrix<double>& matrix, bool transposed, const double* b, double* x) const;

  int determinantSign() const;
  double factorEntries() const { return factorEntries_; }
  double flops() const { return flops_; }

 private:
  struct Free {
    void (*function)(void**);
    void operator()(void* object) const { function(&object); }
  };
  std::unique_ptr<void, Free> symbolic_{nullptr, Free{nullptr}};
  std::unique_ptr<void, Free> numeric_{nullptr, Free{nullptr}};
  double factorEntries_ = 0;
  double flops_ = 0;
};

}  // namespace pliant::math
