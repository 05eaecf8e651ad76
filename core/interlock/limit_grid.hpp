#pragma once

#include "core/interlock/deformation_test.hpp"

namespace pliant::interlock {

struct LimitGridOptions {
  int directions = 36;  ///< of the principal axes, over half a turn
  int steps = 20;       ///< of the principal strain, between its limits
  double perturbation = 0.01;
  unsigned seed = 1;
};

/// The limits across a principal direction that is stretched by a given amount.
struct GridSlice {
  double angle = 0;                      ///< of the principal direction [rad]
  double wanted = 0;                     ///< principal strain that was asked for
  double principal = 0;                  ///< that was reached: the cell may lock on its way
  bool missed = false;                   ///< whether they differ
  DirectionLimit stretched, compressed;  ///< across, with the principal strain held
};

/// The set of in-plane deformations by slices, as the thesis explores it (4.3.3): principal directions, principal
/// strains in each, and in each of these the limits across. Unlike rays from the middle slices ask for no star shape,
/// but they find only what can be reached with these principal axes.
struct LimitGrid {
  std::vector<GridSlice> slices;  ///< one direction after the other, principal strains ascending
  base::TerminationType termination = base::TerminationType::failed;
  std::string message;

  int missedCount() const;
  double largestGap() const;  ///< [m]
  long iterations() const;    ///< of the limits
};

/// Computed in parallel; the same for any number of threads.
LimitGrid computeLimitGrid(const CellSolver& solver, const LimitGridOptions& options, base::ExecutionContext& context);

}  // namespace pliant::interlock
