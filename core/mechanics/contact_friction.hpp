#pragma once

#include "core/mechanics/contact_barrier.hpp"

namespace pliant::mechanics {

struct FrictionOptions {
  double coefficient = 0;  ///< μ
  double creep = 0;        ///< ε of CreepLaw, above 0: how far contacts creep that hold [m]
};

/// Coulomb's friction over one increment, by a lagged potential (Li et al. 2020, "Incremental potential contact",
/// section 5.5): each pair of primitives that touches keeps its normal force N, its plane and its closest points, and
/// adds μ N f(u) (CreepLaw), where u is how far these points have slid along the plane since `before`. It is convex and
/// 0 before, so that its force only takes energy. Positions are those of the barrier, of all its nodes.
class ContactFriction {
 public:
  /// Of the contacts of `barrier` at `touching` (3 x nodes) [m], for which it is updated. A sphere has no points that
  /// turn with it: a ball about its own middle drags nothing along.
  ContactFriction(ContactBarrier& barrier, Eigen::Matrix3Xd before, const Eigen::Matrix3Xd& touching,
                  const FrictionOptions& options);

  double value(const Eigen::Matrix3Xd& x) const;  ///< [J]
  /// As ContactBarrier's.
  void addGradient(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& gradient) const;
  void addHessian(const Eigen::Matrix3Xd& x, std::vector<ContactBlock>& blocks) const;
  /// Each two deformable nodes that a contact couples, in no order and more than once.
  std::vector<std::array<int, 2>> coupledNodes() const;

  /// What it has taken on the way from `before` to x: force times slide, over all contacts, never negative [J].
  double dissipated(const Eigen::Matrix3Xd& x) const;
  /// Σ μ N, which no slide's forces exceed [N].
  double largestForce() const;
  int contactCount() const { return static_cast<int>(contacts_.size()); }
  /// Of contacts that have slid farther than the creep at x, the forces with which their surfaces push each other over
  /// those of all; 0 without any.
  double slidingShare(const Eigen::Matrix3Xd& x) const;

 private:
  struct Touch {
    ContactPair pair;
    Eigen::Vector4d weights;               ///< of the corners: x_A - x_B of the points that touch
    Eigen::Matrix<double, 3, 2> tangents;  ///< orthonormal
    double force;                          ///< μ N [N]
  };
  Eigen::Vector2d slideOf(const Touch& touch, const Eigen::Matrix3Xd& x) const;

  std::vector<Touch> contacts_;
  Eigen::Matrix3Xd before_;
  double creep_;
  int deformableCount_;
};

}  // namespace pliant::mechanics
