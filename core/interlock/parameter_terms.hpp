#pragma once

#include <span>

#include "core/interlock/cell_rate.hpp"

namespace pliant::interlock {

/// Derivatives of CellContact::energy by numbers of the cell's geometry, with the places of its elements kept.
struct ParameterTerms {
  Eigen::VectorXd ofEnergy;    ///< ∂E/∂p, one a number
  Eigen::MatrixXd ofGradient;  ///< ∂²E/∂q∂p: a row a coordinate, a column a number
};

/// Of the pairs at `state`, where none overlap. Exact: with f(q, p, u) = ½|X_A - X_B|² and D = min_u f,
/// ∂D/∂p = f_p and ∂²D/∂q∂p = f_qp - f_qu f_uu⁻¹ f_up. Ends of arcs move with their curve and along it.
ParameterTerms parameterTerms(const CellContact& contact, const CellState& state, const std::vector<PartPair>& pairs,
                              const CellContact::Barrier& barrier, std::span<const CellRate> rates);

/// How the gap of a pair of parts changes with each number, for elements that keep their places in the plane's rest
/// state as the cell says: positions, rotations and lattice change too.
Eigen::VectorXd gapRateAtRest(const CellContact& contact, const PartPair& pair, std::span<const CellRate> rates);

}  // namespace pliant::interlock
