#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/harmonic/response_point.hpp"

namespace pliant::harmonic {

/// How a resonance peak of a response curve moves with design parameters.
struct PeakSensitivity {
  double omega = 0;            ///< of the peak [rad/s], located to rounding
  Vector z;                    ///< its motion
  double amplitude = 0;        ///< its path length [m]; without probes the norm of the oscillation's coefficients
  Vector omegaDerivative;      ///< dω*/dp, an entry a parameter
  Vector amplitudeDerivative;  ///< dA*/dp
  double residual = 0;         ///< ‖h‖ / forceScale there
};

/// A peak is a largest amplitude A(u, p) on the curve h(u, p) = 0, u = (z, ω): a stationary point of the Lagrangian
/// L = A - λᵀh along the curve's tangent t. So
///   dA*/dp = ∂L/∂p,   du*/dp = v + α t,   α = -(d/ds ∂L/∂p + (d/ds ∂L/∂u)ᵀ v) / (d/ds ∂L/∂u)ᵀ t,
/// where v = du/dp normal to t and d/ds is the derivative along t, taken as a difference of order 4 of exact
/// first derivatives. All systems are bordered, so folds nearby do no harm; three solves with the transpose do for any
/// number of parameters.
///
/// `peak` is a point of the kind peak, of a curve of this problem (see HarmonicResult::problemOf); it is located more
/// exactly first. `parameters` are indices in `Model::parameters`. None if it is no strict peak or two curves cross
/// there.
std::optional<PeakSensitivity> peakSensitivity(const HarmonicBalanceProblem& problem, const ResponsePoint& peak,
                                               const std::vector<int>& parameters);

/// The same for a peak of `problem` that is near `peak`, which may be one of other parameters: found by Newton's method
/// onto the curve and along it. None if it is farther away than about half the swing or a quarter of the frequency.
std::optional<PeakSensitivity> followPeak(const HarmonicBalanceProblem& problem, const ResponsePoint& peak,
                                          const std::vector<int>& parameters);

/// How a point of a response curve moves with design parameters: along the curve's normal, in the measure of
/// BorderedJacobian, since a move along the curve is none.
struct PointSensitivity {
  Vector omega;       ///< dω/dp, an entry a parameter; empty if two curves cross here
  Matrix pathLength;  ///< dA/dp, probes x parameters
};
PointSensitivity pointSensitivity(const HarmonicBalanceProblem& problem, const ResponsePoint& point,
                                  const std::vector<int>& parameters);

/// A point of the curve foretold for other parameters.
struct PredictedPoint {
  double omega = 0;
  std::vector<double> pathLengths;  ///< a probe each
};
/// The point at p + Δp to first order; the point itself where its sensitivity is empty. A few nanoseconds a parameter.
PredictedPoint predictPoint(const ResponsePoint& point, const PointSensitivity& sensitivity,
                            const Vector& parameterChange);

}  // namespace pliant::harmonic
