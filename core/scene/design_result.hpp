#pragma once

#include "core/harmonic/constrained_design.hpp"
#include "core/harmonic/floquet_stability.hpp"
#include "core/harmonic/multi_start.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// What a design was to keep to.
struct DesignConstraints {
  std::vector<harmonic::DesignConstraint> list;                ///< empty if there was nothing
  std::vector<std::vector<harmonic::ConstraintState>> states;  ///< of each design in the history, a constraint each
  solvers::Optimality optimality;                              ///< of the last design
};

/// The way from a scene's design to a better one.
class DesignResult final : public Result {
 public:
  std::string kind() const override { return "design"; }
  Json summary() const override;
  /// summary.json, history.csv (a row a design), parameters.csv, trajectories.csv (of the probes, before and after, and
  /// of the target paths in phase with what came of them).
  void write(const std::filesystem::path& directory) const override;
  /// Of the last design's motion, also if it is unstable.
  std::vector<std::string> warnings() const override;

  /// The motion of a design, as the study "periodic_motion" gives it, without its stability and sensitivities.
  std::shared_ptr<HarmonicResult> motionOf(const harmonic::DesignIterate& design) const;
  /// The frequency of a design's motion [rad/s], which may be one of the parameters.
  double omegaOf(const harmonic::DesignIterate& design) const;
  const harmonic::DesignIterate& before() const { return design.history.front(); }
  const harmonic::DesignIterate& after() const { return design.history.back(); }
  /// Designs, their motions, and how they were found. The history is empty if the first design has no motion, and
  /// shorter than the way while the study runs.
  harmonic::InverseDesignResult design;

  /// Where the optimiser began, the scene's own design first, and which one led to the best; empty if it was one alone.
  std::vector<harmonic::DesignStart> starts;
  int bestStart = 0;

  /// Set when the study ends.
  DesignConstraints constraints;

  harmonic::Stability stability;  ///< of the last design's motion; unknown if not asked for
  double omega = 0;               ///< of the first design [rad/s]
  int harmonics = 0;
  int samples = 0;
  std::vector<int> parameters;            ///< that could change, by index in `Model::parameters`
  std::vector<harmonic::PathGoal> paths;  ///< of the objectives of the type "path"
};

}  // namespace pliant::scene
