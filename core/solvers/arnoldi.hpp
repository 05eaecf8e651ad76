#pragma once

#include <Eigen/Core>
#include <functional>

namespace pliant::solvers {

/// Approximations to the eigenvalues of largest modulus of a real operator.
struct RitzPairs {
  Eigen::VectorXcd values;   ///< by falling modulus
  Eigen::MatrixXcd vectors;  ///< in the basis of the Krylov space, a column each, of length 1
  Eigen::VectorXd errors;    ///< ‖A x − θ x‖ for x of length 1
};

/// Arnoldi's method without restarts: an orthonormal basis of the Krylov space of A and a start vector, which grows as
/// long as its owner wants more. Orthogonalised again where much is taken away, so it stays orthonormal to working
/// precision.
class Arnoldi {
 public:
  using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  /// `start` must not be zero; `maximumSteps` is the largest dimension.
  Arnoldi(Operator apply, const Eigen::VectorXd& start, int maximumSteps);

  /// Adds up to `steps` vectors, each with one application of the operator.
  void extend(int steps);
  int dimension() const { return dimension_; }
  /// True if A leaves the space where it is: the Ritz pairs are eigenpairs.
  bool invariant() const { return invariant_; }
  /// True if the space can grow no more: it is invariant, or has its largest dimension, or A gave no finite vector.
  bool exhausted() const { return exhausted_; }
  RitzPairs ritzPairs() const;
  /// The vector with these coordinates in the basis.
  Eigen::VectorXcd expand(const Eigen::VectorXcd& coordinates) const;

 private:
  Operator apply_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd hessenberg_;
  int dimension_ = 0;
  bool invariant_ = false;
  bool exhausted_ = false;
};

}  // namespace pliant::solvers
