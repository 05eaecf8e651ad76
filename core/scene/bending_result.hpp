#pragma once

#include "core/interlock/bending_limit.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// What results about a finite patch have in common.
class PatchResult : public InterlockResult {
 public:
  std::shared_ptr<const interlock::UnitCell> patch;

 protected:
  /// Head of the summary: what the numbers hold for.
  Json patchSummary() const;
  /// Writes contacts.csv, elements.csv and patch.ply of one state of the patch.
  void writeConfiguration(class ResultFolder& folder, const interlock::CellEquilibrium& rest) const;
};

/// One limit: "bending_test".
class BendingTestResult final : public PatchResult {
 public:
  Json summary() const override;
  /// summary.json, contacts.csv, elements.csv, patch.ply (at the limit, or as it folded).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  interlock::BendingLimit limit;
};

/// Limits in many directions: "curvature_limits".
class CurvatureLimitsResult final : public PatchResult {
 public:
  Json summary() const override;
  /// summary.json, curvature_limits.csv (a row a direction and sign).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  std::vector<interlock::BendingLimits> directions;
};

/// Limits over the size: "bending_size". `patch` is that of the last size.
class BendingSizeResult final : public PatchResult {
 public:
  /// Of one size: bent up in the direction with the curvature across free; domes with both curvatures equal, up and
  /// down; saddles with opposite ones, up along the direction and down along it.
  struct Size {
    double radius = 0;  ///< asked for [m]
    int elements = 0;
    std::array<interlock::BendingLimit, 5> limits;
  };
  static constexpr std::array<const char*, 5> names = {"single", "dome_up", "dome_down", "saddle_up", "saddle_down"};

  Json summary() const override;
  /// summary.json, bending_size.csv (a row a size and kind of curvature).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  std::vector<Size> sizes;
};

/// All limits of bending: "bending_boundary".
class BendingBoundaryResult final : public PatchResult, public LimitSurface {
 public:
  Json summary() const override;
  /// summary.json, boundary.csv (a row a limit, exact), boundary.ply (the closed surface; coordinates are the
  /// curvatures k_xx, k_yy, k_xy [1/m]).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  const BoundarySpace& space() const override { return curvatureSpace(); }
  Eigen::Vector3d coordinates(const Eigen::Vector3d& strain) const override;
  std::shared_ptr<const interlock::UnitCell> body() const override { return patch; }
  std::string table() const override;
};

/// At rest under gravity: "gravity_bending".
class GravityBendingResult final : public PatchResult {
 public:
  Json summary() const override;
  /// summary.json, contacts.csv, elements.csv, patch.ply.
  void write(const std::filesystem::path& directory) const override;

  interlock::CellEquilibrium rest;
  std::vector<int> clamped;
  double direction = 0;                                ///< from the clamped side to the free one [rad]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();   ///< [m/s²]
  double weight = 0;                                   ///< of all elements [N]
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();  ///< of contacts on the clamped elements [N]
};

/// "locked", "folded", "unsettled".
std::string_view nameOf(interlock::BendingKind kind);

/// (k_xx, k_yy, k_xy) [1/m] of (mean, deviator, twist).
Eigen::Vector3d curvatureTensor(const Eigen::Vector3d& curvature);

}  // namespace pliant::scene
