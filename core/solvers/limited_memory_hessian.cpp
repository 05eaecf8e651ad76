#include "core/solvers/limited_memory_hessian.hpp"

#include <Eigen/LU>
#include <limits>

namespace pliant::solvers {

namespace {

/// The matrix with one more column; without its first one if it would have more than `most`.
Eigen::MatrixXd appended(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& column, int most) {
  const Eigen::Index kept = std::min<Eigen::Index>(matrix.cols(), most - 1);
  Eigen::MatrixXd result(column.size(), kept + 1);
  if (kept > 0) result.leftCols(kept) = matrix.rightCols(kept);
  result.col(kept) = column;
  return result;
}

}  // namespace

void LimitedMemoryHessian::update(const Eigen::VectorXd& s, const Eigen::VectorXd& y) {
  const double product = s.dot(y);
  if (!(product > std::numeric_limits<double>::epsilon() * y.squaredNorm())) return;
  s_ = appended(s_, s, memory_);
  y_ = appended(y_, y, memory_);
  theta_ = y.squaredNorm() / product;
  const Eigen::Index count = s_.cols();
  w_.resize(s.size(), 2 * count);
  w_ << y_, theta_ * s_;
  const Eigen::MatrixXd products = s_.transpose() * y_;
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(2 * count, 2 * count);
  inverse.topLeftCorner(count, count).diagonal() = -products.diagonal();
  inverse.bottomLeftCorner(count, count) = products.triangularView<Eigen::StrictlyLower>();
  inverse.topRightCorner(count, count) = inverse.bottomLeftCorner(count, count).transpose();
  inverse.bottomRightCorner(count, count) = theta_ * s_.transpose() * s_;
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(inverse);
  if (factors.isInvertible())
    m_ = factors.inverse();
  else
    forget(theta_);
}

void LimitedMemoryHessian::forget(double theta) {
  theta_ = theta;
  s_.resize(w_.rows(), 0);
  y_.resize(w_.rows(), 0);
  w_.resize(w_.rows(), 0);
  m_.resize(0, 0);
}

}  // namespace pliant::solvers
