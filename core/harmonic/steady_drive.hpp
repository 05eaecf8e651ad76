#pragma once

#include <vector>

#include "core/mechanics/prescribed_motion.hpp"

namespace pliant::harmonic {

/// Which of the instants, spread evenly over the drive's period or periods, it is at which a drive is nearest to the
/// mean of its motion: its steady place (HarmonicBalanceProblem::setDriveFraction). The first of those that are equally
/// near but for rounding, so that the place does not jump when the drive changes a little.
int steadySample(const mechanics::PrescribedMotion& drive, const mechanics::Vector& rest,
                 const std::vector<math::Phases>& instants);

}  // namespace pliant::harmonic
