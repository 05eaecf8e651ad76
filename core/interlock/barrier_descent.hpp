#pragma once

#include "core/interlock/cell_equilibrium.hpp"
#include "core/interlock/friction_step.hpp"

namespace pliant::interlock {

/// Into how many parts a barrier cuts each arc whose contacts have this mean gap; `radius`: smallest of all pieces [m].
int splitAtGap(double gap, double radius);

/// Minimises an objective under contact by a barrier that shrinks, with Newton steps of limited length: what statics of
/// cells and of finite patches have in common. Those who derive from it say what the unknowns are.
class BarrierDescent {
 public:
  virtual ~BarrierDescent() = default;

  /// Until contacts are as near as `options` ask for.
  CellEquilibrium run(const EquilibriumOptions& options);
  /// The barrier alone, at its widest, until Newton's decrement over the barrier's weight is below the tolerance.
  CellState relax(const EquilibriumOptions& options, double tolerance = 1e-6);
  /// With one barrier that is kept, until Newton's decrement over its weight is below the tolerance or nothing lowers
  /// it any more.
  CellEquilibrium settle(const CellContact::Barrier& barrier, double tolerance, int maximumIterations);
  /// Adds what the way since a state before costs; null: nothing.
  void setFriction(const FrictionStep* friction) { friction_ = friction; }
  /// How hard the structure is pulled, over the lengths that its unknowns are.
  double drivingForce() const { return weightFor(1); }

 protected:
  /// `radius`: smallest of all pieces [m].
  BarrierDescent(const CellContact& contact, const CellState& start, double radius,
                 const base::ExecutionContext* context);

  enum class Outcome { minimum, reached, unlimited, noProgress, iterationLimit, cancelled };

  /// Objective without the barrier; 0 at the start or anywhere else.
  virtual double objective(const CellState& state) const = 0;
  /// Energy of contact at state_ and its smallest gap, and all derivatives, of friction too, which direction() needs.
  virtual double linearize(const CellContact::Barrier& barrier, double& gap) = 0;
  /// Newton's direction at state_ as a velocity of CellState; sets decrement_.
  virtual Eigen::VectorXd direction() = 0;
  virtual CellState advanced(const CellState& state, const Eigen::VectorXd& velocity, double step) const = 0;
  /// The largest step, up to 1, that passes nothing by.
  virtual double largestStep(const Eigen::VectorXd& velocity, double range) const = 0;
  /// How far two points of elements or images that are near each other move relative to one another at most [m], for
  /// a step of the whole velocity.
  virtual double relativePath(const Eigen::VectorXd& velocity, double reach) const = 0;
  /// How far each element moves at most beyond a straight line, for a step of the whole velocity; for shorter ones at
  /// most in proportion [m].
  virtual Eigen::VectorXd pathBeyond(const Eigen::VectorXd& velocity) const;
  /// The weight of the barrier that balances the drive at `gap` [m].
  virtual double weightFor(double gap) const = 0;
  virtual bool hasReached() const = 0;
  virtual bool isUnlimited() const = 0;

  const CellContact& contact_;
  const CellState start_;
  const double radius_;
  const double pathLimit_;  ///< [m]
  double trust_;            ///< longest step along an eigenvector [m]
  CellState state_;
  std::vector<PartPair> pairs_;  ///< near enough for the barrier at state_
  double decrement_ = 0;         ///< Newton's, at the last point looked at
  int iterations_ = 0;
  const FrictionStep* friction_ = nullptr;

 private:
  /// What is minimised, but for contact.
  double costOf(const CellState& state) const;
  /// Newton's method for one barrier.
  Outcome minimize(const CellContact::Barrier& barrier, double tolerance, int maximumIterations);
  /// `step` made shorter so that pieces which are thin against it pass nothing by.
  double collisionFreeStep(const Eigen::VectorXd& velocity, double step, double range) const;
  void measure(const CellContact::Barrier& barrier, CellEquilibrium& result);
  /// How it ended, and where.
  void finish(Outcome outcome, const CellContact::Barrier& barrier, CellEquilibrium& result) const;

  const bool thin_;
  const base::ExecutionContext* context_;
};

}  // namespace pliant::interlock
