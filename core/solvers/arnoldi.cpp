#include "core/solvers/arnoldi.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace pliant::solvers {

namespace {

/// Of its length that a vector must keep when it is orthogonalised, or else it is orthogonalised again (Daniel, Gragg,
/// Kaufman & Stewart 1976).
constexpr double enoughLeft = 0.7;
/// Of its length that rounding leaves to a vector that was in the space.
constexpr double invariantRest = 1e-14;

}  // namespace

Arnoldi::Arnoldi(Operator apply, const Eigen::VectorXd& start, int maximumSteps)
    : apply_(std::move(apply)),
      basis_(start.size(), maximumSteps + 1),
      hessenberg_(Eigen::MatrixXd::Zero(maximumSteps + 1, maximumSteps)) {
  basis_.col(0) = start.normalized();
}

void Arnoldi::extend(int steps) {
  const int end = std::min(dimension_ + steps, static_cast<int>(hessenberg_.cols()));
  while (dimension_ < end && !exhausted_) {
    Eigen::VectorXd next = apply_(basis_.col(dimension_));
    const double before = next.norm();
    if (!std::isfinite(before)) {
      exhausted_ = true;
      return;
    }
    const auto known = basis_.leftCols(dimension_ + 1);
    auto column = hessenberg_.col(dimension_).head(dimension_ + 1);
    double rest = before;
    double length = 0;
    do {
      length = rest;
      const Eigen::VectorXd part = known.transpose() * next;
      next.noalias() -= known * part;
      column += part;
      rest = next.norm();
    } while (rest < enoughLeft * length && rest > invariantRest * before);
    ++dimension_;
    invariant_ = rest <= invariantRest * before || dimension_ == next.size();
    exhausted_ = invariant_ || dimension_ == hessenberg_.cols();
    hessenberg_(dimension_, dimension_ - 1) = rest;
    basis_.col(dimension_) = rest > 0 ? Eigen::VectorXd(next / rest) : next;
  }
}

RitzPairs Arnoldi::ritzPairs() const {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(hessenberg_.topLeftCorner(dimension_, dimension_));
  const Eigen::VectorXcd& values = eigen.eigenvalues();
  const Eigen::MatrixXcd vectors = eigen.eigenvectors();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(dimension_));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(values[a]) > std::abs(values[b]); });
  RitzPairs pairs{values(order), vectors(Eigen::all, order), {}};
  pairs.vectors.colwise().normalize();
  pairs.errors = std::abs(hessenberg_(dimension_, dimension_ - 1)) * pairs.vectors.row(dimension_ - 1).cwiseAbs();
  return pairs;
}

Eigen::VectorXcd Arnoldi::expand(const Eigen::VectorXcd& coordinates) const {
  return basis_.leftCols(dimension_) * coordinates;
}

}  // namespace pliant::solvers
