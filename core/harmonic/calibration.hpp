#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/harmonic/measured_motion.hpp"
#include "core/harmonic/periodic_motion.hpp"
#include "core/solvers/bounded_least_squares.hpp"
#include "core/solvers/parameter_uncertainty.hpp"

namespace pliant::harmonic {

struct CalibrationOptions {
  std::vector<int> parameters;  ///< to be fitted, by index in `Model::parameters`
  double level = 0.95;          ///< of the confidence intervals
  PeriodicMotionOptions motion;
  /// Of variables that are the parameters' places between their bounds, 0 to 1.
  solvers::BoundedLeastSquaresOptions fit{.gradientTolerance = 1e-7, .valueTolerance = 1e-10, .maximumStep = 0.3};
};

/// Parameters on the way.
struct CalibrationIterate {
  int iteration = 0;          ///< 0 for the first values
  Vector values;              ///< of the fitted parameters
  double rootMeanSquare = 0;  ///< of the residuals [m]
  double cosine = 0;          ///< largest between the residuals and what a parameter changes of them
  int evaluations = 0;
  int solves = 0;  ///< motions solved for so far, at all frequencies
};

/// A measured motion with what fits it.
struct CalibratedMotion {
  MotionFit before, after;       ///< with the first and the last parameters
  double timeOffset = 0;         ///< [s], in a period from 0 if estimated
  double rootMeanSquare = 0;     ///< of the residuals [m]
  double swing = 0;              ///< root mean square of the measured values from their means [m]
  double serialCorrelation = 0;  ///< Σ rᵢ rᵢ₊₁ / Σ rᵢ² of successive residuals of a coordinate
  Vector zBefore, z;
};

struct CalibrationResult {
  base::SolverReport report;  ///< of the fit; failed with a sentence if the first parameters have no motion
  std::vector<CalibrationIterate> history;
  std::vector<CalibratedMotion> motions;  ///< a measured motion each; empty if there is no history
  std::shared_ptr<const Model> before, after;
  solvers::ParameterUncertainty uncertainty;  ///< in units of the parameters
  std::vector<int> atBound;                   ///< of each parameter: -1 at its minimum, 1 at its maximum, else 0
  int sampleCount = 0;
  int failedFits = 0;  ///< trial parameters with which a motion was not found
};

/// Fits parameters of `problem`'s model within their bounds to measured motions: least squares over all samples (thesis
/// 2.5.2) by Levenberg's and Marquardt's method, with dz/dp (2.4.3) for the derivative. At every driving frequency the
/// branch of motions is followed as `designInversely` does; parameters with which a motion cannot be reached so shorten
/// the step. Uncertainties are those of the linearised fit: errors of all samples independent, of one size.
///
/// `onIterate` is called with every accepted iterate. On cancellation, the best parameters so far, with uncertainties
/// of the linearisation there. Throws base::InputError with fewer samples than unknowns, or where a parameter moves the
/// place that displacements are measured from.
CalibrationResult calibrate(const HarmonicBalanceProblem& problem, std::vector<MeasuredMotion> measured,
                            const CalibrationOptions& options, base::ExecutionContext& context,
                            const std::function<void(const CalibrationIterate&)>& onIterate = {});

}  // namespace pliant::harmonic
