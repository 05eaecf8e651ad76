#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/periodic_motion.hpp"

namespace pliant::harmonic {

struct DesignSpaceOptions {
  double omega = 0;             ///< [rad/s]
  std::vector<int> parameters;  ///< that differ between designs, by index in `Model::parameters`
  int count = 100;              ///< designs, besides the first
  unsigned seed = 1;
  double progress = 1;  ///< how much of the whole this is, from 0 on
  PeriodicMotionOptions motion;
};

/// How a design's motion was found.
enum class MotionOrigin {
  none,      ///< it was not
  followed,  ///< from that of another design, on its branch
  anew       ///< as that of a first design, since the branch of the nearest one does not lead there
};

struct SampledDesign {
  Vector variables;  ///< 0 to 1 between the bounds
  Vector values;
  MotionOrigin origin = MotionOrigin::none;
  int from = -1;                       ///< the design that it was followed from
  std::shared_ptr<const Model> model;  ///< null without a motion, as is what follows
  Vector z;
  double residual = 0;                ///< ‖h‖ / forceScale
  std::vector<Amplitude> amplitudes;  ///< a probe each
};

struct DesignSpace {
  base::SolverReport report;           ///< failed if no design has a motion
  std::vector<SampledDesign> designs;  ///< the first is that of the model
};

/// Motions of designs that fill the space between the parameters' bounds evenly (EvenPoints): each is followed from the
/// nearest design that was solved before (as in designInversely; it must not be beyond a fold), or found anew if that
/// fails. Designs are solved in batches, whose members do not wait for one another, so the result does not depend on
/// the number of threads. `onBatch` gets what there is so far. On cancellation, the designs of all whole batches.
DesignSpace sampleDesignSpace(const HarmonicBalanceProblem& problem, const DesignSpaceOptions& options,
                              base::ExecutionContext& context,
                              const std::function<void(const DesignSpace&)>& onBatch = {});

/// Indices of the points (columns x and y, the larger the better) that no other one beats in both, by rising x.
std::vector<int> paretoFront(const Matrix& points);

}  // namespace pliant::harmonic
