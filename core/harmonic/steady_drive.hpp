#pragma once

#include "core/mechanics/prescribed_motion.hpp"

namespace pliant::harmonic {

/// The sample, of `samples` evenly over `periods` periods, at which a drive is nearest to the mean of its motion: its
/// steady place (HarmonicBalanceProblem::setDriveFraction). The first of those that are equally near but for rounding,
/// so that the place does not jump when the drive changes a little.
int steadySample(const mechanics::PrescribedMotion& drive, const mechanics::Vector& rest, int samples, int periods);

}  // namespace pliant::harmonic
