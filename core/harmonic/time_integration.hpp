#pragma once

#include <complex>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/harmonic/newmark.hpp"

namespace pliant::harmonic {

struct TimeIntegrationOptions {
  int stepsPerPeriod = 256;
  int maximumPeriods = 500;
  double tolerance = 1e-6;  ///< on e_p / stepsPerPeriod, relative to the swing of the last period
  /// Periods from which the start of the next one is extrapolated (Anderson 1965), so that transients of little damping
  /// need not die away; 0: none, the motion that the model would take. Extrapolation also finds unstable motions.
  int acceleration = 0;
  /// Instead: once the motion is nearly periodic, Newton's method on the start of a period (shooting), with the
  /// monodromy matrix by central differences, two periods a state (of positions and velocities). It finds unstable
  /// motions as well, and tells the multipliers: for checks of small models.
  bool shooting = false;
};

/// Free coordinates beyond which shooting is refused.
inline constexpr int mostShootingCoordinates = 500;

/// One period of the integration.
struct PeriodRecord {
  /// e_p = Σᵢ ‖x(tᵢ) - x(tᵢ - T)‖ over the steps (thesis 2.5.1), of all coordinates [m]; 0 for the first period.
  double difference = 0;
  bool extrapolated = false;  ///< it did not begin where the one before had ended
};

struct TimeIntegration {
  double omega = 0;
  int steps = 0;      ///< a period
  Matrix positions;   ///< last period, steps x coordinates [m]; row i at τ = 2π i / steps
  Vector velocities;  ///< at the end of it, where the next begins [m/s]
  double swing = 0;   ///< √(mean over the period of ‖x - mean x‖²) [m]
  /// Of a shooting that converged: growth over one period of all small disturbances of the discrete motion, the largest
  /// first; 2 nFree.
  std::vector<std::complex<double>> multipliers;
  std::vector<PeriodRecord> periods;
  long newtonIterations = 0;
  long factorizations = 0;
  base::SolverReport report;  ///< residual of a record: e_p / steps relative to the swing

  double difference() const { return periods.empty() ? 0 : periods.back().difference; }
};

/// Integrates until two successive periods agree. Starts at the static equilibrium of τ = 0, moving with the drive as
/// if it were slow, or at the motion with the coefficients `start`. A motion that is not periodic with the drive's
/// period ends at the limit of periods. Throws base::InputError for fewer than 8 steps, and for shooting with more than
/// mostShootingCoordinates free coordinates.
TimeIntegration integrateToPeriodicity(const HarmonicBalanceProblem& problem, double omega,
                                       const TimeIntegrationOptions& options, base::ExecutionContext& context,
                                       const Vector& start = {});

}  // namespace pliant::harmonic
