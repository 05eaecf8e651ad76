#pragma once

#include "core/harmonic/linear_modes.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// Linear modes of one model about its static equilibrium.
class ModesResult final : public Result {
 public:
  std::string kind() const override { return "modes"; }
  Json summary() const override;
  /// summary.json, modes.csv (a row a coordinate: the equilibrium and every mode's mass-normalised shape), mesh.ply
  /// (the equilibrium, if there are triangles).
  void write(const std::filesystem::path& directory) const override;
  /// Mode i as coefficients of `problem` that oscillate like sin τ about the equilibrium, its largest coordinate by
  /// `swing` [m]: to be played like any periodic motion.
  mechanics::Vector motion(std::size_t i, double swing) const;

  /// One harmonic, with the drive at rest.
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  harmonic::LinearModes modes;
};

}  // namespace pliant::scene
