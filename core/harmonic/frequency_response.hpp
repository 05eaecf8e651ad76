#pragma once

#include <functional>
#include <vector>

#include "core/harmonic/periodic_motion.hpp"
#include "core/harmonic/response_point.hpp"

namespace pliant::harmonic {

struct FrequencyResponseOptions {
  double from = 0;         ///< first frequency [rad/s]; may be above `to`: the curve is traced downwards
  double to = 0;           ///< the curve ends where it crosses `from` or `to` again [rad/s]
  double initialStep = 0;  ///< in the scaled arc length; 0: 0.005
  double minimumStep = 0;  ///< 0: initialStep / 4096
  double maximumStep = 0;  ///< 0: limited by curvature and by a fortieth of the range in frequency alone
  int maximumPoints = 2000;
  double locationTolerance = 1e-6;  ///< relative error of the frequency of folds, peaks and bifurcations
  bool stability = true;            ///< find the stability of every point, and the bifurcations
  /// How many times over to follow the curves that branch off at branch points and period doublings. 1: those that
  /// branch off the first curve; 2: also those that branch off these, and so on.
  int branchDepth = 0;
  Vector start;  ///< coefficients near which the first motion is looked for; empty: from rest
  PeriodicMotionOptions newton;
};

struct FrequencyResponse {
  std::vector<ResponsePoint> points;  ///< in the order of the curve, those located among them
  base::SolverReport report;          ///< one record a point
};

/// Throws base::InputError if a frequency is not finite and positive or the range is empty.
void requireFrequencyRange(double from, double to);

/// Pseudo-arclength continuation (2.3.18, 2.3.19) with step control, through folds, until the curve leaves the range;
/// the last point lies exactly on the range's end. Folds (dω/ds = 0) and resonance peaks of every probe's path length
/// (dA/ds changes from positive to negative) are located and stand among the points. A model without probes has the
/// peaks of the root mean square swing of its free coordinates, ‖z without constants‖. With `stability`, so are the
/// bifurcations (see StabilityTracker), and the located ones count as stable if one side of them is. `onPoint` is
/// called with each point as it is found (from the calling thread). If cancelled or stuck, the points so far are
/// returned with the reason. Throws base::InputError if a frequency is not finite and positive or the range is empty.
FrequencyResponse traceFrequencyResponse(HarmonicBalanceProblem& problem, const FrequencyResponseOptions& options,
                                         base::ExecutionContext& context,
                                         const std::function<void(const ResponsePoint&)>& onPoint = {});

}  // namespace pliant::harmonic
