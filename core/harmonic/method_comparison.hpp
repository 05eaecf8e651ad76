#pragma once

#include <vector>

#include "core/harmonic/periodic_motion.hpp"
#include "core/harmonic/time_integration.hpp"

namespace pliant::harmonic {

struct MethodComparisonOptions {
  std::vector<int> harmonics;  ///< ascending: harmonic balance with each
  int samples = 64;            ///< of a period for those, or 4H+1 if that is more
  std::vector<int> steps;      ///< ascending multiples of the first: Newmark integrations with as many steps a period
  int samplesHarmonics = 5;    ///< harmonics of the solutions with as many samples as Newmark has steps
  int maximumSamples = 512;    ///< up to this number of them
  TimeIntegrationOptions integration;
  PeriodicMotionOptions newton;
};

/// One solution. Differences are the mean over the times of the coarsest integration of ‖x - x'‖, of all coordinates
/// [m]: e of (2.5.1) divided by the number of steps.
struct ComparedSolution {
  int harmonics = 0;       ///< 0: Newmark
  int samples = 0;         ///< or steps
  double toNewmark = 0;    ///< difference from the finest integration (with `sameSamples`, from that of as many steps)
  double toReference = 0;  ///< difference from the reference
  bool sameSamples = false;  ///< one of the solutions that have as many samples as Newmark has steps
  int periods = 0;           ///< Newmark: integrated
  double seconds = 0;
  base::TerminationType termination = base::TerminationType::failed;
};

struct MethodComparison {
  std::vector<ComparedSolution> solutions;
  double swing = 0;  ///< √(mean of ‖x - mean x‖²) of the reference [m]; 0 if there is none to compare with
  base::SolverReport report;
};

/// Harmonic balance against Newmark's method at one frequency, as in Figs. 2.3 (more harmonics) and 2.15 (more samples
/// and steps). Each harmonic balance starts at the one before, and each integration at the motion with the most
/// harmonics, so all are of one motion. Numbers of harmonics that have no motion, but for the last, are named in the
/// report's message and make no failure. The reference is Richardson's extrapolation of the two finest integrations,
/// whose errors of second order in the step cancel; the finest integration if there is one alone. Throws
/// base::InputError if the lists are empty, not ascending, or no multiples.
MethodComparison compareMethods(std::shared_ptr<const Model> model, double omega,
                                const MethodComparisonOptions& options, base::ExecutionContext& context);

}  // namespace pliant::harmonic
