#include "core/interlock/patch_system.hpp"

#include <Eigen/Dense>

namespace pliant::interlock {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void PatchSystem::begin(const std::vector<std::array<int, 2>>& pairs, int borderCount) {
  bool known = cholesky_ != nullptr;
  for (const auto& pair : pairs) known = known && indices_.contains(pair);
  if (!known) {
    // Pairs that were near before stay, so that elements that come and go do not cause an analysis each time.
    for (const auto& pair : pairs) indices_.try_emplace(pair, static_cast<int>(indices_.size()));
    std::vector<std::array<int, 2>> couplings;
    for (int i = 0; i < count_; ++i) couplings.push_back({2 * i, 2 * i + 1});
    for (const auto& [pair, index] : indices_)
      for (const int i : {0, 1})
        for (const int j : {0, 1}) couplings.push_back({2 * pair[0] + i, 2 * pair[1] + j});
    cholesky_ = std::make_unique<math::BlockCholesky>(2 * count_, couplings, math::OrderingEffort::quick);
  }
  for (Matrix6& block : diagonal_) block.setZero();
  blocks_.assign(indices_.size(), Matrix6::Zero());
  gradient.setZero(6 * Eigen::Index{count_});
  borderGradient.setZero(borderCount);
  border.setZero(6 * Eigen::Index{count_}, borderCount);
  corner.setZero(borderCount, borderCount);
}

void PatchSystem::addBlock(int row, int column, const Eigen::Matrix3d& block) {
  const auto [offset, stride, transposed] = cholesky_->place(row, column);
  double* values = cholesky_->values() + offset;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) values[j * Eigen::Index{stride} + i] += transposed ? block(j, i) : block(i, j);
}

bool PatchSystem::factorize(double shift) {
  cholesky_->clear();
  for (int i = 0; i < count_; ++i) {
    const Matrix6& own = diagonal_[i];
    addBlock(2 * i, 2 * i, own.topLeftCorner<3, 3>() + shift * Eigen::Matrix3d::Identity());
    addBlock(2 * i + 1, 2 * i + 1, own.bottomRightCorner<3, 3>() + shift * Eigen::Matrix3d::Identity());
    addBlock(2 * i, 2 * i + 1, own.topRightCorner<3, 3>());
  }
  for (const auto& [pair, index] : indices_)
    for (const int i : {0, 1})
      for (const int j : {0, 1}) addBlock(2 * pair[0] + i, 2 * pair[1] + j, blocks_[index].block<3, 3>(3 * i, 3 * j));
  return cholesky_->factorize();
}

bool PatchSystem::solve(double shift, VectorXd& step, VectorXd& borderStep) {
  if (!factorize(shift)) return false;
  const Eigen::Index inner = border.cols(), held = constraints.cols(), all = inner + held;
  VectorXd base = -gradient;
  cholesky_->solve(base);
  MatrixXd edges(gradient.size(), all), columns(gradient.size(), all);
  edges << border, constraints;
  VectorXd column;
  for (Eigen::Index k = 0; k < all; ++k) {
    column = edges.col(k);
    cholesky_->solve(column);
    columns.col(k) = column;
  }
  MatrixXd schur = -edges.transpose() * columns;
  schur.topLeftCorner(inner, inner) += corner + shift * MatrixXd::Identity(inner, inner);
  VectorXd right = -edges.transpose() * base;
  right.head(inner) -= borderGradient;
  // The constraints' own block is negative definite; without them the border's must be positive definite.
  MatrixXd reduced = schur.topLeftCorner(inner, inner);
  VectorXd reducedRight = right.head(inner);
  Eigen::LLT<MatrixXd> ofConstraints;
  if (held > 0) {
    ofConstraints.compute(-schur.bottomRightCorner(held, held));
    if (ofConstraints.info() != Eigen::Success) return false;
    reduced += schur.topRightCorner(inner, held) * ofConstraints.solve(schur.bottomLeftCorner(held, inner));
    reducedRight += schur.topRightCorner(inner, held) * ofConstraints.solve(right.tail(held));
  }
  borderStep.setZero(inner);
  if (inner > 0) {
    const Eigen::LLT<MatrixXd> solver(reduced);
    if (solver.info() != Eigen::Success) return false;
    borderStep = solver.solve(reducedRight);
  }
  step = base - columns.leftCols(inner) * borderStep;
  if (held > 0)
    step -= columns.rightCols(held) *
            ofConstraints.solve(schur.bottomLeftCorner(held, inner) * borderStep - right.tail(held));
  return step.allFinite() && borderStep.allFinite();
}

}  // namespace pliant::interlock
