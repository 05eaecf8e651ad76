#pragma once

#include <complex>
#include <vector>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/floquet_stability.hpp"

namespace pliant::harmonic {

/// What is special about a point of a response curve. The last three are bifurcations other than folds: where a Floquet
/// multiplier leaves the unit circle.
enum class PointKind {
  regular,
  fold,            ///< the frequency turns back; a multiplier passes +1
  peak,            ///< of a probe's path length
  branchPoint,     ///< a multiplier passes +1 where the frequency does not turn: two curves cross
  periodDoubling,  ///< a multiplier passes -1: motions that repeat after two periods branch off
  neimarkSacker,   ///< a pair of multipliers leaves the unit circle: motions that never repeat branch off
};

/// One solution on a curve.
struct ResponsePoint {
  PointKind kind = PointKind::regular;
  int branch = 0;        ///< which curve it is on: 0 is the first, others branch off at bifurcations
  int drivePeriods = 1;  ///< periods of the drive in one period of z
  int probe = -1;        ///< peak: of which probe; -1 for a model without probes
  double omega = 0;      ///< [rad/s]
  double arcLength = 0;  ///< along the curve, in the scaled measure (Δz / swing at the start, Δω / range)
  Vector z;              ///< coefficients
  std::vector<Amplitude> amplitudes;  ///< a probe each
  double residual = 0;                ///< ‖h‖ / forceScale
  double correction = 0;  ///< the last one of z, relative to the swing (of the curve's start): how far z may be off
  int newtonIterations = 0;
  Stability stability;  ///< unknown if not asked for
};

/// Which multiplier to look at: at a bifurcation that on the unit circle, elsewhere the largest; 0 if none is known.
std::complex<double> criticalMultiplier(const ResponsePoint& point);

}  // namespace pliant::harmonic
