#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace pliant::math {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// LU of a square sparse matrix. The symbolic analysis is kept and reused as long as the pattern stays the same.
///
/// Matrices made of dense blocks, such as the Jacobians of harmonic balance (bordered or not), are factorised by our
/// own supernodal method on all threads (SupernodalFactorization); others, and those whose pivot blocks turn out to be
/// singular, by UMFPACK. The bytes of the results do not depend on the number of threads. Different objects may be used
/// from different threads at once; so may the const members of one object.
class SparseFactorization {
 public:
  SparseFactorization();
  ~SparseFactorization();
  SparseFactorization(SparseFactorization&&) noexcept;
  SparseFactorization& operator=(SparseFactorization&&) noexcept;

  /// False if the matrix is singular to working precision (its condition number, with rows and columns scaled to
  /// like size, is estimated above 1/ε) or holds a number that is not finite. Throws std::invalid_argument if it is
  /// not square.
  bool factorize(const SparseMatrix& matrix);

  /// Solves A x = b, or Aᵀ x = b, for the matrix last factorised, with iterative refinement: one step, and more only if
  /// that one found an error above half the digits. `b` is n x m. Only after factorize() returned true.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  Eigen::MatrixXd solveTransposed(const Eigen::MatrixXd& b) const;

  /// The same for A x = b to about half the digits, for half the price: refined only where pivots were poor.
  Eigen::MatrixXd solveRoughly(const Eigen::MatrixXd& b) const;

  /// ‖b − A x‖ / (‖A‖ ‖x‖ + ‖b‖) in the maximum norm, the largest over the columns: the smallest relative change of A
  /// and b of which x is the exact solution (Rigal & Gaches 1967).
  double backwardError(const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) const;

  /// Sign of the determinant, +1 or -1 (0 if singular): it changes where a branch folds or branches.
  int determinantSign() const;
  /// Entries in the factors; floating-point operations of the last factorisation.
  double factorEntries() const;
  double flops() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant::math
