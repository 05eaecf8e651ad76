#pragma once

#include "core/interlock/limit_grid.hpp"
#include "core/scene/limit_surface.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// What results about an interlocking material have in common.
class InterlockResult : public Result {
 public:
  std::string kind() const override { return "interlock"; }

  std::shared_ptr<const interlock::UnitCell> cell;

 protected:
  /// Head of the summary: what the numbers hold for.
  Json materialSummary() const;
};

/// One limit: "cell_test".
class CellTestResult final : public InterlockResult {
 public:
  Json summary() const override;
  /// summary.json, contacts.csv, elements.csv (where they are), patch.ply (3 x 3 cells at the limit).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  interlock::DirectionLimit limit;
};

/// Limits in many directions: "free_travel".
class FreeTravelResult final : public InterlockResult {
 public:
  Json summary() const override;
  /// summary.json, free_travel.csv (a row a direction).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  std::vector<interlock::FreeTravel> directions;
};

/// Limits by slices: "stretch_grid".
class StretchGridResult final : public InterlockResult {
 public:
  Json summary() const override;
  /// summary.json, limits.csv (a row a slice).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  interlock::LimitGrid grid;
};

/// All limits of in-plane deformation: "stretch_boundary".
class StretchBoundaryResult final : public InterlockResult, public LimitSurface {
 public:
  Json summary() const override;
  /// summary.json, boundary.csv (a row a limit, exact), boundary.ply (the closed surface; coordinates are Green strain
  /// E_x, E_y, E_xy).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  const BoundarySpace& space() const override { return strainSpace(); }
  Eigen::Vector3d coordinates(const Eigen::Vector3d& strain) const override { return interlock::greenStrain(strain); }
  std::shared_ptr<const interlock::UnitCell> body() const override { return cell; }
  std::string table() const override;
};

/// "locked", "reached", "unlimited".
std::string_view nameOf(interlock::RestKind kind);

}  // namespace pliant::scene
