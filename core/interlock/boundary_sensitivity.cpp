#include "core/interlock/boundary_sensitivity.hpp"

#include <algorithm>
#include <atomic>

#include "core/math/parallel.hpp"

namespace pliant::interlock {

int BoundarySensitivity::count(LimitSensitivity::Kind kind) const {
  return static_cast<int>(std::count(kinds.begin(), kinds.end(), kind));
}

BoundarySensitivity boundarySensitivity(const CellSolver& solver, const StrainSpaceBoundary& boundary,
                                        std::span<const CellRate> rates, base::ExecutionContext& context) {
  BoundarySensitivity result;
  const std::size_t count = boundary.states.size();
  result.slopes.setZero(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(rates.size()));
  result.kinds.assign(count, LimitSensitivity::Kind::unsettled);
  std::atomic<int> done = 0;
  math::parallelFor(static_cast<int>(count), [&](int i) {
    if (context.cancelRequested()) return;
    const auto index = static_cast<std::size_t>(i);
    const BoundaryState& state = boundary.states[index];
    if (state.termination == base::TerminationType::converged && state.kind == RestKind::locked) {
      const LimitSensitivity own =
          limitSensitivity(solver, state.cell, rayDrive(boundary.mesh.directions[index]), rates, nullptr, &context);
      result.kinds[index] = own.kind;
      if (own.kind != LimitSensitivity::Kind::unsettled) result.slopes.row(i) = own.slopes.transpose();
    }
    context.reportProgress(++done / static_cast<double>(count));
  });
  result.termination = context.cancelRequested() ? base::TerminationType::cancelled : base::TerminationType::converged;
  return result;
}

StrainSpaceBoundary predictedBoundary(const StrainSpaceBoundary& boundary, const BoundarySensitivity& sensitivity,
                                      const Eigen::VectorXd& change) {
  StrainSpaceBoundary predicted = boundary;
  const Eigen::VectorXd grown = sensitivity.slopes * change;
  for (std::size_t i = 0; i < predicted.states.size(); ++i)
    predicted.states[i].distance = std::max(0.0, predicted.states[i].distance + grown[static_cast<Eigen::Index>(i)]);
  return predicted;
}

}  // namespace pliant::interlock
