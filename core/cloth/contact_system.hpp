#pragma once

#include <memory>
#include <optional>

#include "core/mechanics/contact_barrier.hpp"
#include "core/solvers/cone_elements.hpp"

namespace pliant::cloth {

/// The matrix of a projection with contact, over the nodes that are not fixed: masses, stretch limits (see
/// solvers::ConeElements) and the Hessian of the contact energy. Contacts come and go; what couples them is analysed
/// anew only where a contact is not foreseen in the factors that there are.
class ContactSystem {
 public:
  using Positions = Eigen::Matrix3Xd;

  /// Nodes of `contact` are those of the constraints, followed by the bodies' points.
  ContactSystem(solvers::ConeConstraints constraints, std::shared_ptr<mechanics::ContactBarrier> contact);

  solvers::ConeElements& elements() { return *elements_; }
  const mechanics::ContactBarrier& contact() const { return *contact_; }
  const std::vector<int>& freeNodes() const { return nodeOfVertex_; }

  /// Where everything is from now on: nodes and bodies' points.
  void moveTo(const Positions& all) { contact_->update(all); }

  /// Assembles the matrix: inertia M, the limits' part with the slacks and multipliers there are, and the contacts'
  /// Hessian `scale` times, with convexity as in ContactElement. Writes the limits' `forces` and `predictorForces`.
  solvers::ConeElements::Linearization assemble(const Positions& x, double scale, double inertia, double convexity,
                                                Positions& forces, Positions& predictorForces);
  /// False if the matrix is not positive definite; it is to be assembled again then.
  bool factorize() { return cholesky_->factorize(); }
  /// dx of the free nodes; other columns are left as they are.
  void solve(const Positions& right, Positions& dx);
  /// dxᵀ H dx with the contacts' Hessian as last assembled, without its scale.
  double contactCurvature(const Positions& dx) const;

 private:
  void foresee();

  solvers::ConeConstraints constraints_;
  std::shared_ptr<mechanics::ContactBarrier> contact_;
  std::vector<int> vertexOfNode_, nodeOfVertex_;
  std::vector<std::array<int, 2>> limitPairs_;  ///< vertices that limits couple
  std::vector<std::vector<int>> coupled_;  ///< per vertex those before it that the factors have room for, ascending
  std::optional<math::BlockCholesky> cholesky_;
  std::optional<solvers::ConeElements> elements_;
  std::vector<mechanics::ContactBlock> blocks_;  ///< as last assembled
  Eigen::VectorXd unknowns_;
};

}  // namespace pliant::cloth
