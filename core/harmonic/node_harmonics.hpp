#pragma once

#include "core/harmonic/periodic_motion.hpp"

namespace pliant::harmonic {

/// A motion whose nodes have as many harmonics as each needs.
struct NodeHarmonicsMotion {
  HarmonicBalanceProblem problem;
  PeriodicMotion motion;
  /// Estimate of how far the harmonics left out would move any node, relative to the longest path of a probe (of a
  /// node, if there are no probes). NaN if there is no motion.
  double leftOut;
};

/// Raises the harmonics of each node (and of each scalar coordinate) from `problem`'s until those left out would move
/// no node by more than `relativeChange` of the longest path, up to `maximumHarmonics`; samples grow to at least 4H+1.
/// If `maximumHarmonics` were not enough, the report says iterationLimit.
///
/// What is left out is estimated from the residual of a series with two harmonics more than the longest (odd and even
/// ones, since symmetric models answer with one kind alone): each harmonic's equations are solved by themselves, for
/// the coordinates that lack it, and then, with the factors that are there, what the other coefficients answer, which
/// is the larger part near a resonance. That costs two evaluations and H factorisations of 2 x 2 blocks a pair of
/// coordinates, a small part of a Newton iteration. It tells sizes, not digits.
NodeHarmonicsMotion solveWithHarmonicsPerNode(HarmonicBalanceProblem problem, double omega, double relativeChange,
                                              int maximumHarmonics, const PeriodicMotionOptions& options,
                                              base::ExecutionContext& context);

}  // namespace pliant::harmonic
