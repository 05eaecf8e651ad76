#pragma once

#include "core/cloth/cloth_simulation.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// A cloth at one instant.
struct ClothFrame {
  double time = 0;             ///< [s]; of a drape: the number of the load step
  Eigen::Matrix3Xd positions;  ///< of all nodes [m]
  Eigen::Matrix3Xd bodyPoints; ///< of the points of all bodies, one body after the other [m]
  Eigen::VectorXd stretchRatios;    ///< per triangle of the sheet: see cloth::stretchRatios
  Eigen::VectorXd limitForces;      ///< per triangle: tr Λ of its cones, 0 where no limit is active [J s²]
};

/// One step of time, recorded whether or not its frame is kept.
struct ClothStepRecord {
  double time = 0;  ///< at its end [s]
  cloth::Energies energies;
  double violation = 0;    ///< largest stretch over limit - 1
  double relativeGap = 0;  ///< of its last projection
  int newtonIterations = 0;
  int projectionIterations = 0;
  double newtonSeconds = 0;
  double projectionSeconds = 0;
  double smallestGap = 0;  ///< to bodies and itself [m]; infinite if nothing is near
  bool converged = true;
};

/// A drape, a motion or a single projection of a cloth: "cloth_drape", "cloth_motion", "projection".
class ClothResult final : public Result {
 public:
  std::string kind() const override { return "cloth"; }
  Json summary() const override;
  /// summary.json, steps.csv (a row a step: energies, violation, gap, times), convergence.csv (the last projection,
  /// a row an iteration), frames/frame_00000.ply ..., triangles.csv (of the last frame: ratio and multiplier),
  /// frames.csv (number and time).
  void write(const std::filesystem::path& directory) const override;
  static std::shared_ptr<ClothResult> read(const Scene& scene, const std::filesystem::path& directory);

  std::shared_ptr<const cloth::ClothProblem> problem;
  std::vector<std::shared_ptr<const ClothFrame>> frames;
  std::vector<ClothStepRecord> steps;
  base::SolverReport lastProjection;  ///< its iterations, for the solver plot
};

}  // namespace pliant::scene
