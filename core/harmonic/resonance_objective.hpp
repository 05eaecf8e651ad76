#pragma once

#include "core/harmonic/design_objective.hpp"
#include "core/harmonic/periodic_motion.hpp"

namespace pliant::harmonic {

// Objectives that depend on the design alone, not on its motion at the frequency of the design. Where a design has no
// such resonance, or no static equilibrium, their value is infinite.

/// A peak of the response curve is to lie at a frequency: ((ω* - frequency) / frequency)², ω* being that of the nearest
/// peak of a probe's path length, with the drive as it is (see PeakSensitivity).
struct ResonancePlacement {
  double frequency = 0;  ///< [rad/s]
  int probe = 0;         ///< index in Model::probes; -1 for a model without probes
  double from = 0;       ///< the curve is traced from here to `to` to find the first design's peak [rad/s]
  double to = 0;
  PeriodicMotionOptions motion;
};
/// The peak is followed from one design to the next, so designs should come in small steps, from one thread at a time;
/// where it is lost, the curve is traced again.
std::shared_ptr<const DesignObjective> makeResonancePlacement(const ResonancePlacement& goal);

/// The same of a natural frequency about the static equilibrium: what a response curve has in the limit of small drives
/// and little damping, for the price of an eigenvalue.
struct LinearResonancePlacement {
  double frequency = 0;     ///< [rad/s]
  std::optional<int> mode;  ///< from 0, by rising frequency; the nearest if left out
};
std::shared_ptr<const DesignObjective> makeLinearResonancePlacement(LinearResonancePlacement goal);

/// No natural frequency is to lie within `halfWidth` of a frequency: Σ max(0, 1 - ((ω - frequency) / halfWidth)²)² over
/// all modes, which has a continuous derivative, is 1 for a mode at the frequency and 0 for those outside the band.
struct ResonanceAvoidance {
  double frequency = 0;  ///< [rad/s]
  double halfWidth = 0;  ///< [rad/s]
};
std::shared_ptr<const DesignObjective> makeResonanceAvoidance(ResonanceAvoidance goal);

/// Those of this file, for objectiveKinds().
std::vector<ObjectiveKind> resonanceObjectiveKinds();

}  // namespace pliant::harmonic
