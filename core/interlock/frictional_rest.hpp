#pragma once

#include <functional>
#include <memory>

#include "core/interlock/barrier_descent.hpp"

namespace pliant::interlock {

/// Rest with friction, EquilibriumOptions::friction, by increments: in each the structure follows its drive against a
/// drag under which nothing moves farther than `length` [m], with the contacts, normal forces and places of the
/// increment before (see FrictionStep). It rests once an increment moves nothing by more than contacts creep, a
/// thousandth of `length`. Friction holds what pulls less than μ times the normal force, so where it rests depends on
/// the way there; whether it holds is told to 0.002 of the pull, and contacts that are new in an increment hold from
/// the next one on. `make` gives the search from a state, whose drag on the strain is measured by `strainLength` [m].
CellEquilibrium restWithFriction(const CellContact& contact, const CellState& start, const EquilibriumOptions& options,
                                 double length, double strainLength,
                                 const std::function<std::unique_ptr<BarrierDescent>(const CellState&)>& make);

}  // namespace pliant::interlock
