#include "core/solvers/cone_objective.hpp"

#include <utility>

namespace pliant::solvers {

ConeObjective::ConeObjective(const ConeConstraints& constraints, const std::vector<int>& vertexOfNode,
                             ConeStiffness pattern, const std::vector<std::array<int, 2>>& pairs)
    : masses_(constraints.masses), pattern_(std::move(pattern)) {
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (vertexOfNode[node] >= 0) nodes_.push_back(node);
  if (pattern_.rows.empty()) return;
  cholesky_.emplace(static_cast<int>(nodes_.size()), pairs);
  slots_.assign(pattern_.rows.size(), -1);
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const int row = vertexOfNode[pattern_.rows[s] / 3], column = vertexOfNode[pattern_.columns[s] / 3];
    if (row < 0 || column < 0) continue;
    const math::BlockCholesky::Place place = cholesky_->place(row, column);
    const int i = pattern_.rows[s] % 3, j = pattern_.columns[s] % 3;
    slots_[s] =
        place.offset + (place.transposed ? Eigen::Index{i} * place.stride + j : Eigen::Index{j} * place.stride + i);
  }
}

bool ConeObjective::setStiffness(const Eigen::VectorXd& entries, double inertia) {
  entries_ = entries;
  massFactor_ = 1 + inertia;
  cholesky_->clear();
  addTo(*cholesky_, 1);
  return cholesky_->factorize();
}

void ConeObjective::multiply(const Eigen::Matrix3Xd& offset, Eigen::Matrix3Xd& result) const {
  result = massFactor_ * offset * masses_.asDiagonal();
  for (Eigen::Index s = 0; s < entries_.size(); ++s) {
    if (slots_[static_cast<std::size_t>(s)] < 0) continue;
    const int row = pattern_.rows[static_cast<std::size_t>(s)], column = pattern_.columns[static_cast<std::size_t>(s)];
    result.data()[row] += entries_[s] * offset.data()[column];
    if (row != column) result.data()[column] += entries_[s] * offset.data()[row];
  }
}

double ConeObjective::inverseNorm(const Eigen::Matrix3Xd& residual) const {
  if (entries_.size() == 0) {
    double sum = 0;
    for (const int node : nodes_) sum += residual.col(node).squaredNorm() / masses_[node];
    return sum;
  }
  Eigen::VectorXd right(3 * static_cast<Eigen::Index>(nodes_.size()));
  for (std::size_t v = 0; v < nodes_.size(); ++v)
    right.segment<3>(3 * static_cast<Eigen::Index>(v)) = residual.col(nodes_[v]);
  Eigen::VectorXd solution = right;
  cholesky_->solve(solution);
  return right.dot(solution);
}

void ConeObjective::addTo(math::BlockCholesky& cholesky, double factor) const {
  double* values = cholesky.values();
  for (std::size_t v = 0; v < nodes_.size(); ++v) {
    const math::BlockCholesky::Place place = cholesky.place(static_cast<int>(v), static_cast<int>(v));
    for (int i = 0; i < 3; ++i)
      values[place.offset + Eigen::Index{i} * (place.stride + 1)] += factor * massFactor_ * masses_[nodes_[v]];
  }
  for (Eigen::Index s = 0; s < entries_.size(); ++s)
    if (const Eigen::Index slot = slots_[static_cast<std::size_t>(s)]; slot >= 0) values[slot] += entries_[s];
}

}  // namespace pliant::solvers
