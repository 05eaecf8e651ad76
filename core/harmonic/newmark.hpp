#pragma once

#include <Eigen/SparseCholesky>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// Time integration of a model by Newmark's method with β = 1/4, γ = 1/2 (thesis 2.A.3), the trapezoidal rule
///   x₁ = x₀ + ½ Δt (v₀ + v₁),   M (v₁ - v₀) = ½ Δt (F₀ + F₁)
/// with F = f - ∇E - D v at either end of a step, which is the same as (2.A.19) to (2.A.23) where the equation of
/// motion holds at the start, and needs no accelerations, so massless coordinates may be among the unknowns. Driven
/// coordinates follow their motion and its exact rate. The impulse of the damping force D_β K(x) v over a step is
/// D_β (∇E(x₁) - ∇E(x₀)): exact where the thesis takes the mean of its values at both ends, equal to that for linear
/// forces, and without third derivatives of E in the Jacobian.
class NewmarkIntegration {
 public:
  /// `steps` a period of the angular frequency `omega` [rad/s], at least 8.
  NewmarkIntegration(const HarmonicBalanceProblem& problem, double omega, int steps);

  /// Puts the model at τ = 0. Values of coordinates that are not free are ignored. Sizes: all coordinates.
  void start(const Vector& positions, const Vector& velocities);
  /// One step on; false if Newton's method does not converge or anything is not finite, and the state then stays.
  bool advance();

  /// Of all coordinates [m], [m/s].
  const Vector& positions() const { return now_.positions; }
  const Vector& velocities() const { return now_.velocities; }
  int steps() const { return steps_; }
  double omega() const { return omega_; }
  /// Newton iterations and factorisations so far.
  long newtonIterations() const { return newtonIterations_; }
  long factorizations() const { return factorizations_; }

 private:
  struct State {
    Vector positions;
    Vector velocities;
    Vector gradient;  ///< ∇E, all coordinates
    Vector force;     ///< f - ∇E - D_α M v, free coordinates
  };

  void evaluateForce(State& state, int step) const;
  void setHeldCoordinates(State& state, int step) const;
  bool linearize(const Vector& positions);
  bool solveStep(State& next, int step);
  Vector defect(const State& next) const;

  const Model& model_;
  const mechanics::ElasticAssembler& assembler_;
  double omega_;
  int steps_;
  double duration_;        ///< Δt [s]
  SparseMatrix mass_;      ///< free x all coordinates
  std::vector<int> held_;  ///< coordinates that are not free
  Matrix heldPositions_;   ///< held x steps
  Matrix heldVelocities_;
  State now_;
  Vector origin_;    ///< the positions at the start
  double size_ = 0;  ///< largest displacement from them so far [m]
  Matrix past_;      ///< the positions of up to three steps back, the newest first: for prediction
  int pastCount_ = 0;
  int step_ = 0;  ///< of the period
  SparseMatrix jacobian_;
  Vector massValues_;               ///< of the Jacobian's entries
  std::vector<int> lower_, upper_;  ///< of each stiffness entry: where it and its mirror image go in the Jacobian
  Vector stiffness_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
  bool factorized_ = false;
  double contraction_ = 1;    ///< of the last Newton corrections with the present factors
  double roundingFloor_ = 0;  ///< corrections below this, relative to the size, were seen not to shrink any more
  long newtonIterations_ = 0;
  long factorizations_ = 0;
};

}  // namespace pliant::harmonic
