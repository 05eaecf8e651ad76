#pragma once

#include <vector>

#include "core/interlock/cell_contact.hpp"
#include "core/interlock/contact_terms.hpp"

namespace pliant::interlock {

/// What the way of a structure costs since a state in which it has come to rest: friction, and a drag that keeps the
/// step short, so that the way there counts.
///
/// Friction is that of Coulomb by a lagged potential (Li et al. 2020, "Incremental potential contact", section 5.5):
/// each contact, with its normal force N and its plane, adds μ N f(u) of mechanics::CreepLaw, where u is how far the
/// two places that touched have slid along that plane since. The drag adds ½ k (|Δx|² + (ρ θ)² + (L Δε)²), of the
/// translation and the angle of each element of reach ρ, 3 - tr ΔR for θ², and of the strain.
class FrictionStep {
 public:
  struct Options {
    double coefficient = 0;   ///< μ
    double creep = 0;         ///< ε [m]
    double drag = 0;          ///< k [force/m]
    double strainLength = 0;  ///< L [m]
  };
  /// `contacts`: of the state `touching`, with their forces; as a rule that is the state before.
  FrictionStep(const CellContact& contact, const CellState& before, const CellState& touching,
               const std::vector<CellContactForce>& contacts, const Options& options);

  /// What it adds to the objective, 0 at the state before.
  double energy(const CellState& state) const;

  /// Calls `visit(pair, terms)` for each contact, as CellContact::visitContacts does, with both derivatives.
  void visitContacts(const CellState& state, const CellContact::Visitor& visit) const;
  /// Calls `visit(a, b)` for the elements of each contact.
  template <class Visit>
  void visitPairs(Visit&& visit) const {
    for (const Contact& contact : contacts_) visit(contact.pair.a, contact.pair.b);
  }
  /// Derivatives of the drag on one element by its translation and rotation vector.
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  void elementDrag(const CellState& state, int element, Vector6& gradient, Matrix6& hessian) const;
  /// Of the drag on the strain [force · m].
  Eigen::Vector3d strainDrag(const CellState& state) const;
  double strainDragStiffness() const { return options_.drag * options_.strainLength * options_.strainLength; }
  /// All of it by the coordinates of a velocity (see `moved`), added.
  void addDerivatives(const CellState& state, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const;

 private:
  struct Contact {
    PartPair pair;
    Eigen::Vector3d armA, armB;  ///< of the place where they touched, in the shapes' coordinates [m]
    Eigen::Vector3d before;      ///< X_A - X_B [m]
    Eigen::Matrix<double, 3, 2> tangents;
    double force;  ///< μ N
  };
  /// X_A - X_B [m].
  Eigen::Vector3d betweenPlaces(const Contact& contact, const CellState& state) const;
  /// u along the tangents [m].
  Eigen::Vector2d slideOf(const Contact& contact, const CellState& state) const;

  const CellContact& contact_;
  const CellState before_;
  const Options options_;
  std::vector<Contact> contacts_;
};

}  // namespace pliant::interlock
