#pragma once

#include <optional>

#include "core/interlock/detail_check.hpp"
#include "core/interlock/macro_motion.hpp"
#include "core/interlock/sheet_detail.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

class ResultFolder;

/// The elements themselves under the same loads, and how far the sheet is from their origins.
struct NativeComparison {
  std::shared_ptr<const interlock::UnitCell> patch;  ///< null: read from a folder that does not say how elements turn
  interlock::CellEquilibrium rest;
  Eigen::Matrix3Xd deflections;  ///< of the elements that carry loads [m]
  double seconds = 0;
  int compared = 0;  ///< elements that rest within the sheet
  double meanDistance = 0, largestDistance = 0;
  double size = 0;  ///< of the patch: the largest distance of two origins at rest [m]
};

/// The sheet's elements in their places.
struct PlacedElements {
  interlock::SheetDetail detail;
  interlock::DetailCheck before, check;  ///< at the start of their way, and at its end
};

/// A sheet at one instant.
struct MacroFrame {
  double time = 0;                             ///< [s]; of an equilibrium the part of its loads that acts
  Eigen::Matrix3Xd positions;                  ///< of the nodes [m]
  Eigen::Matrix3Xd bodyPoints;                 ///< of the points of all bodies, one body after the other [m]
  Eigen::VectorXd stretchGauge, bendingGauge;  ///< per triangle: 1 at the limit; 0 without one
  std::optional<interlock::CellState> native;  ///< the native patch under the same part of its loads
  double nativeDistance = 0;                   ///< mean, of its elements from the sheet [m]
};

/// One step of time, recorded whether or not its frame is kept.
struct MacroStepRecord {
  double time = 0;  ///< at its end [s]
  interlock::MacroEnergies energies;
  double stretchGauge = 0, bendingGauge = 0;  ///< the largest
  double smallestGap = 0;                     ///< [m]; infinite: nothing near
  double gripLag = 0, bodyLag = 0;            ///< [m]
  double residual = 0;
  int iterations = 0;
  interlock::SheetFriction friction;  ///< read from files without its contacts
};

/// A sheet at rest under its loads, "macro_equilibrium", or in motion, "macro_motion": then `state` is its last.
class MacroResult final : public InterlockResult {
 public:
  Json summary() const override;
  /// summary.json, nodes.csv, triangles.csv, sheet.ply; with the native patch elements.csv and patch.ply; with
  /// placed elements placed_elements.csv (of the lattice, where and how they are turned); of a motion
  /// steps.csv (a row a step); of a motion or an equilibrium by steps of its loads frames.csv (number and time, or part
  /// of the loads) and frames/frame_00000.ply ... (exact, in doubles), with the native patch
  /// frames/native_00000.csv ... as well, and native.csv of its last state, see elementTable().
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  std::shared_ptr<const interlock::MacroSheet> sheet;
  interlock::MacroState state;
  std::vector<int> clamped;
  std::vector<int> loaded;       ///< nodes that carry loads
  Eigen::Matrix3Xd deflections;  ///< of the nodes that carry loads [m]
  std::vector<mechanics::Body> bodies;
  std::vector<std::shared_ptr<const MacroFrame>> frames;
  std::vector<MacroStepRecord> steps;
  std::optional<PlacedElements> placed;

  /// Whether it is a motion, with frames and steps.
  bool isMotion() const;

  using Native = NativeComparison;
  std::optional<Native> native;

 private:
  Eigen::VectorXd gaugesOf(int material, const Eigen::VectorXd& gauges) const;
  void addMotion(Json& json) const;
  void writeSteps(ResultFolder& folder) const;
  void writeFrames(ResultFolder& folder) const;
  void writeNative(ResultFolder& folder) const;
  void writePlaced(ResultFolder& folder) const;
};

/// For the summary, and from it and placed_elements.csv. Throws base::InputError.
Json placedSummary(const PlacedElements& placed);
PlacedElements readPlaced(const std::filesystem::path& directory, const Json& summary);

/// Of a folder that a motion was written into its steps, and of any with frames these. Throws base::InputError.
void readMacroSteps(const std::filesystem::path& directory, MacroResult& result);
void readMacroFrames(const std::filesystem::path& directory, MacroResult& result);

}  // namespace pliant::scene
