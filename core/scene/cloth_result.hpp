#pragma once

#include "core/cloth/cloth_simulation.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// A cloth at one instant.
struct ClothFrame {
  double time = 0;                ///< [s]; of a drape: the number of the step
  Eigen::Matrix3Xd positions;     ///< of all nodes [m]
  Eigen::Matrix3Xd bodyPoints;    ///< of the points of all bodies, one body after the other [m]
  Eigen::VectorXd stretchRatios;  ///< per triangle of the sheet: see cloth::stretchRatios
  Eigen::VectorXd limitForces;    ///< per triangle: tr Λ of its limit, 0 where none is active [J s²]
};

/// One step of time, recorded whether or not its frame is kept.
struct ClothStepRecord {
  double time = 0;  ///< at its end [s]; of a drape: its number
  cloth::Energies energies;
  double violation = 0;    ///< largest stretch over limit - 1
  double relativeGap = 0;  ///< of its last projection
  double residual = 0;     ///< of a drape: unbalanced force over external force
  int newtonIterations = 0;
  int projectionIterations = 0;
  double newtonSeconds = 0;
  double projectionSeconds = 0;
  double smallestGap = std::numeric_limits<double>::infinity();  ///< to bodies and itself [m]; infinite: nothing near
  bool converged = true;
};

/// A drape, a motion or a single projection of a cloth: "cloth_drape", "cloth_motion", "projection".
class ClothResult final : public Result {
 public:
  std::string kind() const override { return "cloth"; }
  Json summary() const override;
  /// summary.json, steps.csv (a row a step: energies, violation, gap, times), convergence.csv (the last projection,
  /// a row an iteration), frames/frame_00000.ply ... (exact, in doubles), triangles.csv (of the last frame: ratio and
  /// multiplier), frames.csv (number and time); of a projection also optimum.ply.
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;
  /// What `write` wrote for a scene with the same nodes and triangles: the same frames, to the last bit. Throws
  /// base::InputError.
  static std::shared_ptr<ClothResult> read(const Scene& scene, const std::filesystem::path& directory);

  /// "cloth_motion", "cloth_drape" or "projection".
  std::string studyType() const;
  /// The frame nearest to `time`; there must be one.
  std::shared_ptr<const ClothFrame> frameAt(double time) const;

  std::shared_ptr<const cloth::ClothProblem> problem;
  std::vector<std::shared_ptr<const ClothFrame>> frames;
  std::vector<ClothStepRecord> steps;
  base::SolverReport lastProjection;  ///< its iterations, for the solver plot
  /// The last projection, with what proves it; null if there was none, or once read back.
  std::shared_ptr<const solvers::ConeSolution> projection;
};

/// A frame as binary PLY: doubles x, y, z of the nodes; the sheet's triangles with stretch_ratio and limit_force.
std::string frameToPly(const ClothFrame& frame, const cloth::LimitedSheet& sheet);
/// Reads positions, ratios and forces back. Throws base::InputError (location empty) if it is anything but what
/// frameToPly makes of a sheet with as many nodes and triangles.
ClothFrame frameFromPly(std::string_view text, const cloth::LimitedSheet& sheet);

}  // namespace pliant::scene
