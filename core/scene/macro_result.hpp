#pragma once

#include <optional>

#include "core/interlock/macro_simulation.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// The elements themselves under the same loads, and how far the sheet is from their origins.
struct NativeComparison {
  std::shared_ptr<const interlock::UnitCell> patch;
  interlock::CellEquilibrium rest;
  Eigen::Matrix3Xd deflections;  ///< of the elements that carry loads [m]
  double seconds = 0;
  int compared = 0;  ///< elements that rest within the sheet
  double meanDistance = 0, largestDistance = 0;
  double size = 0;  ///< of the patch: the largest distance of two origins at rest [m]
};

/// A sheet at rest under its loads: "macro_equilibrium".
class MacroResult final : public InterlockResult {
 public:
  Json summary() const override;
  /// summary.json, nodes.csv, triangles.csv, sheet.ply; with the native patch elements.csv and patch.ply.
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  std::shared_ptr<const interlock::MacroSheet> sheet;
  interlock::MacroState state;
  std::vector<int> clamped;
  std::vector<int> loaded;       ///< nodes that carry loads
  Eigen::Matrix3Xd deflections;  ///< of the nodes that carry loads [m]

  using Native = NativeComparison;
  std::optional<Native> native;
};

}  // namespace pliant::scene
