#pragma once

#include "core/interlock/limit_sensitivity.hpp"
#include "core/interlock/strain_space_boundary.hpp"

namespace pliant::interlock {

/// How all limits of a boundary change with numbers of the cell's geometry.
struct BoundarySensitivity {
  Eigen::MatrixXd slopes;                     ///< of the distances from the middle: a row a limit, a column a number
  std::vector<LimitSensitivity::Kind> kinds;  ///< of the limits; slopes are 0 where one is unsettled
  base::TerminationType termination = base::TerminationType::failed;

  int count(LimitSensitivity::Kind kind) const;
};

/// Of each limit along its ray from the middle, which is kept in strain: it is a point from which the set is seen, and
/// not one of the material. In parallel. Limits that were not found are unsettled.
BoundarySensitivity boundarySensitivity(const CellSolver& solver, const StrainSpaceBoundary& boundary,
                                        std::span<const CellRate> rates, base::ExecutionContext& context);

/// The boundary for numbers changed by `change`, to first order: distances only, which are at least 0.
StrainSpaceBoundary predictedBoundary(const StrainSpaceBoundary& boundary, const BoundarySensitivity& sensitivity,
                                      const Eigen::VectorXd& change);

}  // namespace pliant::interlock
