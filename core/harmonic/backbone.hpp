#pragma once

#include <functional>

#include "core/harmonic/periodic_motion.hpp"
#include "core/harmonic/response_point.hpp"

namespace pliant::harmonic {

struct BackboneOptions {
  int mode = 1;                 ///< the linear mode that the curve starts from, by rising frequency
  double maximumAmplitude = 0;  ///< the curve ends where some node is this far from its mean position [m]
  int maximumPoints = 500;
  PeriodicMotionOptions newton;
};

/// A frequency-amplitude curve of free motions.
struct Backbone {
  double linearFrequency = 0;         ///< of the mode, where the curve starts [rad/s]
  std::vector<ResponsePoint> points;  ///< by rising arc length; stability is not found
  base::SolverReport report;          ///< one record a point
};

/// The problem of a model's free motions: the same without damping and without what drives it (loads keep their mean,
/// driven coordinates stay at their steady place).
HarmonicBalanceProblem freeProblem(const HarmonicBalanceProblem& problem);

/// The nonlinear normal mode that continues a linear mode about the static equilibrium: periodic motions of
/// `freeProblem` as their amplitude grows, their frequency unknown.
/// Without damping, a motion that comes to rest at some instant runs back the way it came. Counting time from there, it
/// is a cosine series; so only the cosine coefficients are unknown, and the freedom of phase is gone. Motions that
/// never come to rest (whirling) are not on the curve. Folds in frequency are located, as peaks are not. Throws
/// base::InputError if there is no such mode.
Backbone traceBackbone(const HarmonicBalanceProblem& freeProblem, const BackboneOptions& options,
                       base::ExecutionContext& context, const std::function<void(const ResponsePoint&)>& onPoint = {});

}  // namespace pliant::harmonic
