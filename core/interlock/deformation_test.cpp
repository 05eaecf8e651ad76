#include "core/interlock/deformation_test.hpp"

#include <cmath>

#include "core/math/parallel.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Vector3d;

/// d·F·d - 1 = this · strain.
Vector3d along(double angle) { return {1, std::cos(2 * angle), std::sin(2 * angle)}; }

}  // namespace

double strainAlong(const Vector3d& strain, double angle) { return along(angle).dot(strain); }

StrainDrive uniaxialDrive(double angle, bool compress, Lateral lateral, double ratio) {
  StrainDrive drive;
  drive.load = (compress ? -1 : 1) * along(angle);
  // The strain of a principal direction alone, 1 in that direction and 0 across.
  const Vector3d principal = 0.5 * along(angle);
  const Vector3d across(principal[0], -principal[1], -principal[2]);
  if (lateral == Lateral::held) drive.directions = principal;
  if (lateral == Lateral::biaxial) drive.directions = principal + ratio * across;
  if (lateral == Lateral::principal) {
    drive.directions.resize(3, 2);
    drive.directions.col(0) = principal;
    drive.directions.col(1) = across;
  }
  return drive;
}

StrainDrive rayDrive(const Vector3d& direction) {
  StrainDrive drive;
  drive.directions = direction;
  drive.load = direction / direction.squaredNorm();
  return drive;
}

DirectionLimit directionLimit(const CellSolver& solver, double angle, bool compress, const LimitOptions& options,
                              const base::ExecutionContext* context) {
  const StrainDrive drive = uniaxialDrive(angle, compress, options.lateral, options.ratio);
  const CellState rest = restState(solver.contact().cell());
  DirectionLimit best;
  for (int trial = 0; trial < std::max(1, options.trials); ++trial) {
    const unsigned seed = options.seed + static_cast<unsigned>(trial);
    const CellState start = options.perturbation > 0 ? solver.perturbed(rest, options.perturbation, seed) : rest;
    DirectionLimit next{angle, 0, solver.solve(start, drive, context)};
    next.strain = strainAlong(next.equilibrium.state.strain, angle);
    const bool farther = compress ? next.strain < best.strain : next.strain > best.strain;
    if (trial == 0 || (next.equilibrium.converged() && (farther || !best.equilibrium.converged())))
      best = std::move(next);
  }
  return best;
}

std::vector<FreeTravel> freeTravel(const CellSolver& solver, const std::vector<double>& angles,
                                   const LimitOptions& options, base::ExecutionContext& context,
                                   const base::GrowingResults<FreeTravel>::Observer& observe) {
  std::vector<FreeTravel> result(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i)
    for (DirectionLimit* limit : {&result[i].stretch, &result[i].compression}) {
      limit->angle = angles[i];
      limit->equilibrium.termination = base::TerminationType::cancelled;
    }
  base::GrowingResults<FreeTravel> growing(result, 2 * static_cast<int>(angles.size()), context, observe);
  math::parallelFor(static_cast<int>(angles.size()), [&](int i) {
    for (const auto member : {&FreeTravel::stretch, &FreeTravel::compression}) {
      if (context.cancelRequested()) return;
      DirectionLimit limit = directionLimit(solver, angles[i], member == &FreeTravel::compression, options, &context);
      growing.add([&](std::vector<FreeTravel>& all) { all[i].*member = std::move(limit); });
    }
  });
  return result;
}

}  // namespace pliant::interlock
