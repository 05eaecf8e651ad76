#pragma once

#include <optional>
#include <vector>

#include "core/math/block_cholesky.hpp"
#include "core/solvers/cone_program.hpp"

namespace pliant::solvers {

/// The quadratic objective ½ (x - x̂)ᵀ H (x - x̂) of a cone program over the nodes that are not fixed: H = M, or
/// (1 + inertia) M + K.
class ConeObjective {
 public:
  /// `vertexOfNode`: -1 where fixed. `pairs`: of vertices, among them all that `pattern` couples.
  ConeObjective(const ConeConstraints& constraints, const std::vector<int>& vertexOfNode, ConeStiffness pattern,
                const std::vector<std::array<int, 2>>& pairs);

  /// See ConeProgram::setStiffness. False if H is not positive definite.
  bool setStiffness(const Eigen::VectorXd& entries, double inertia);

  /// H times an offset (3 x nodes, 0 where nodes are fixed, and so is the result).
  void multiply(const Eigen::Matrix3Xd& offset, Eigen::Matrix3Xd& result) const;
  /// residualᵀ H⁻¹ residual over the nodes that are not fixed.
  double inverseNorm(const Eigen::Matrix3Xd& residual) const;
  /// Adds H to a matrix over the same vertices and pairs, its masses `factor` times.
  void addTo(math::BlockCholesky& cholesky, double factor) const;

 private:
  std::vector<int> nodes_;  ///< of each vertex
  Eigen::VectorXd masses_;  ///< per node
  double massFactor_ = 1;   ///< 1 + inertia
  ConeStiffness pattern_;
  Eigen::VectorXd entries_;                      ///< empty: H = M
  std::optional<math::BlockCholesky> cholesky_;  ///< of H; none without a pattern
  std::vector<Eigen::Index> slots_;              ///< of each entry in the factors, -1: a fixed node's
};

}  // namespace pliant::solvers
