#pragma once

#include "core/mechanics/contact_friction.hpp"
#include "core/solvers/energy_minimizer.hpp"

namespace pliant::interlock {

/// What friction does to a sheet at the end of an increment.
struct SheetFriction {
  int contacts = 0;         ///< pairs of primitives that rub
  double slidingShare = 0;  ///< of their forces, those of contacts that slide
  double dissipated = 0;    ///< in the increment [J]
  /// By how much the forces of friction would change with the contacts of the end, over the largest there can be: 0 if
  /// they belong to each other, and 1 if nothing is known of them.
  double lag = 0;
};

/// Friction of a sheet, increment by increment. Its contacts are those of where the increment begins, and looked at
/// anew where it ends, until they are the same.
class SheetFrictionSolver {
 public:
  using Surroundings = solvers::EnergyMinimizer::Surroundings;

  /// `contact` as of the minimizer, which must outlive it.
  SheetFrictionSolver(solvers::EnergyMinimizer& minimizer, std::shared_ptr<mechanics::ContactBarrier> contact,
                      const mechanics::FrictionOptions& options);

  /// A new increment, from `all`: positions of the sheet and the points of the bodies (3 x nodes) [m].
  void begin(const Eigen::Matrix3Xd& all);
  /// Takes the contacts at `all`; returns `lag` with those before.
  double renew(const Eigen::Matrix3Xd& all);
  /// Of the increment that ends at `all`, with the contacts by which it was found.
  SheetFriction judged(const Eigen::Matrix3Xd& all) const;

 private:
  Eigen::Matrix3Xd forcesAt(const mechanics::ContactFriction& friction, const Eigen::Matrix3Xd& all) const;
  std::shared_ptr<const mechanics::ContactFriction> make(const Eigen::Matrix3Xd& touching) const;
  double difference(const mechanics::ContactFriction& other, const Eigen::Matrix3Xd& all) const;

  solvers::EnergyMinimizer& minimizer_;
  std::shared_ptr<mechanics::ContactBarrier> contact_;
  mechanics::FrictionOptions options_;
  Eigen::Matrix3Xd before_;
  std::shared_ptr<const mechanics::ContactFriction> current_;
};

/// How a sheet comes to rest with friction.
struct FrictionalRestOptions {
  double creep = 0;    ///< see FrictionOptions [m]
  double longest = 0;  ///< of an increment, on the way [m]
};

/// Rest of a sheet with friction, which depends on the way there: that of a slow motion from where it starts, of
/// increments with a drag so strong that it moves `longest` in each at most or little more. The drag fades as motion
/// does, and at rest there is none left, and no contact has slid farther than the creep in the last increment.
class FrictionalRest {
 public:
  /// `masses` per node [kg], by which the drag acts.
  FrictionalRest(solvers::EnergyMinimizer& minimizer, std::shared_ptr<mechanics::ContactBarrier> contact,
                 Eigen::Matrix3Xd bodyPoints, Eigen::VectorXd masses, double coefficient,
                 const FrictionalRestOptions& options);

  /// As EnergyMinimizer::minimize, from the way so far; iterations of all increments.
  base::SolverReport settle(mechanics::Vector& x, const solvers::EnergyMinimizer::Surroundings& surroundings,
                            const solvers::EnergyMinimizerOptions& options, base::ExecutionContext& context);
  int increments() const { return increments_; }
  /// Of the last increment.
  const SheetFriction& friction() const { return last_; }

 private:
  Eigen::Matrix3Xd all(const mechanics::Vector& x) const;
  void adaptDrag(double moved, double firstDrag);
  /// One increment from x; its friction is in last_.
  base::SolverReport increment(mechanics::Vector& x, const solvers::EnergyMinimizer::Surroundings& surroundings,
                               const solvers::EnergyMinimizerOptions& options, base::ExecutionContext& context);

  solvers::EnergyMinimizer& minimizer_;
  SheetFrictionSolver solver_;
  Eigen::Matrix3Xd bodyPoints_;
  Eigen::VectorXd masses_;
  FrictionalRestOptions options_;
  double drag_ = -1;  ///< [1/s²]; below 0: not known yet
  int increments_ = 0;
  SheetFriction last_;
};

}  // namespace pliant::interlock
