#include "core/cloth/contact_system.hpp"

#include <algorithm>

namespace pliant::cloth {

namespace {

/// Contacts are foreseen whose gap is by this part of the range above it.
constexpr double foresight = 0.3;

}  // namespace

ContactSystem::ContactSystem(solvers::ConeConstraints constraints, std::shared_ptr<mechanics::ContactBarrier> contact)
    : constraints_(std::move(constraints)), contact_(std::move(contact)), vertexOfNode_(constraints_.nodeCount, -1) {
  for (int node = 0; node < constraints_.nodeCount; ++node)
    if (!constraints_.fixed[node]) {
      vertexOfNode_[node] = static_cast<int>(nodeOfVertex_.size());
      nodeOfVertex_.push_back(node);
    }
  for (const solvers::ConeElement& element : constraints_.elements)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < a; ++b) {
        const int p = vertexOfNode_[element.nodes[a]], q = vertexOfNode_[element.nodes[b]];
        if (p >= 0 && q >= 0) limitPairs_.push_back({std::max(p, q), std::min(p, q)});
      }
  unknowns_.resize(3 * static_cast<Eigen::Index>(nodeOfVertex_.size()));
  foresee();
}

/// Makes room for the contacts there are and those that may soon be.
void ContactSystem::foresee() {
  std::vector<std::array<int, 2>> pairs = limitPairs_;
  for (const auto& [a, b] : contact_->coupledNodes(foresight * contact_->options().range)) {
    const int p = vertexOfNode_[a], q = vertexOfNode_[b];
    if (p >= 0 && q >= 0) pairs.push_back({std::max(p, q), std::min(p, q)});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  coupled_.assign(nodeOfVertex_.size(), {});
  for (const auto& [p, q] : pairs) coupled_[p].push_back(q);
  cholesky_.emplace(static_cast<int>(nodeOfVertex_.size()), pairs, math::OrderingEffort::quick);
  if (elements_)
    elements_->locate(vertexOfNode_, *cholesky_);
  else
    elements_.emplace(constraints_, vertexOfNode_, *cholesky_);
}

solvers::ConeElements::Linearization ContactSystem::assemble(const Positions& x, double scale, double inertia,
                                                             double convexity, Positions& forces,
                                                             Positions& predictorForces) {
  blocks_.clear();
  contact_->addHessian(blocks_, convexity);
  const auto hasRoom = [&](const mechanics::ContactBlock& block) {
    const auto [q, p] = std::minmax(vertexOfNode_[block.row], vertexOfNode_[block.column]);
    return q < 0 || p == q || std::binary_search(coupled_[p].begin(), coupled_[p].end(), q);
  };
  if (!std::all_of(blocks_.begin(), blocks_.end(), hasRoom)) foresee();

  cholesky_->clear();
  forces.setZero();
  predictorForces.setZero();
  const auto linearization = elements_->linearize(x, forces, predictorForces, *cholesky_);
  double* values = cholesky_->values();
  for (const mechanics::ContactBlock& block : blocks_) {
    const int p = vertexOfNode_[block.row], q = vertexOfNode_[block.column];
    if (p < 0 || q < 0) continue;
    const auto place = cholesky_->place(p, q);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        values[place.offset + Eigen::Index{j} * place.stride + i] +=
            scale * (place.transposed ? block.entry(j, i) : block.entry(i, j));
  }
  for (std::size_t v = 0; v < nodeOfVertex_.size(); ++v) {
    const auto place = cholesky_->place(static_cast<int>(v), static_cast<int>(v));
    for (int i = 0; i < 3; ++i)
      values[place.offset + Eigen::Index{i} * (place.stride + 1)] += inertia * constraints_.masses[nodeOfVertex_[v]];
  }
  return linearization;
}

void ContactSystem::solve(const Positions& right, Positions& dx) {
  for (std::size_t v = 0; v < nodeOfVertex_.size(); ++v)
    unknowns_.segment<3>(3 * static_cast<Eigen::Index>(v)) = right.col(nodeOfVertex_[v]);
  cholesky_->solve(unknowns_);
  for (std::size_t v = 0; v < nodeOfVertex_.size(); ++v)
    dx.col(nodeOfVertex_[v]) = unknowns_.segment<3>(3 * static_cast<Eigen::Index>(v));
}

double ContactSystem::contactCurvature(const Positions& dx) const {
  double sum = 0;
  for (const mechanics::ContactBlock& block : blocks_)
    if (vertexOfNode_[block.row] >= 0 && vertexOfNode_[block.column] >= 0)
      sum += (block.row == block.column ? 1 : 2) * dx.col(block.row).dot(block.entry * dx.col(block.column));
  return sum;
}

}  // namespace pliant::cloth
