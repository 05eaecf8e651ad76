#pragma once

#include <span>

#include "core/interlock/cell_equilibrium.hpp"
#include "core/interlock/cell_rate.hpp"

namespace pliant::interlock {

/// How a limit changes with numbers of the cell's geometry.
struct LimitSensitivity {
  enum class Kind {
    smooth,    ///< the derivatives hold
    saddle,    ///< the state is at rest, but on a saddle of the energy: it may leave on any small change
    unsettled  ///< no state at rest was found near by, as where two nearest places of a contact are about to merge
  };
  Kind kind = Kind::unsettled;
  /// Of load · ε at the limit with one barrier kept [1]: the derivatives by the numbers, over their units.
  Eigen::VectorXd slopes;
  /// -∂(Lagrangian)/∂p with the contacts' forces as multipliers: what `slopes` becomes as gaps vanish.
  Eigen::VectorXd envelope;
  double value = 0;      ///< load · ε there, not from a start
  double decrement = 0;  ///< Newton's, over the barrier's weight
  CellContact::Barrier barrier{0, 0, 1};
  CellState state;  ///< where contacts balance the load under that barrier
};

/// The limit at which `drive` (a load alone) locked the cell, to first order in the numbers of `rates`. At a limit
/// ∇_x [-load · ε + E(x, p)] = 0 with the barrier's energy E, so
///   dx/dp = -H⁻¹ ∂²E/∂x∂p,   d(load · ε)/dp = load · dε/dp,
/// for the very barrier that holds it, whatever its weight (implicit differentiation). The objective itself is an
/// optimal value, so its derivative is ∂E/∂p = -Σ force ∂gap/∂p alone (envelope theorem); the two differ as the gaps
/// do. Unknowns that nothing holds, as turns of a ring about its axis, stay where they are. `barrier` null: one with
/// the range of the solver's last, and the weight with which `state` balances best. A limit where contacts change has
/// one-sided derivatives without any gap; barriers blend them over changes of the numbers as large as the gap, so there
/// the derivatives hold no farther than that.
LimitSensitivity limitSensitivity(const CellSolver& solver, const CellState& state, const StrainDrive& drive,
                                  std::span<const CellRate> rates, const CellContact::Barrier* barrier = nullptr,
                                  const base::ExecutionContext* context = nullptr);

}  // namespace pliant::interlock
