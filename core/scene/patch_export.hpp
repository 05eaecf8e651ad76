#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "core/base/execution_context.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// A piece of an interlocking material to be printed.
struct PatchRequest {
  std::string cell;   ///< name in "interlocking_cells"; empty: that of the study, or the only one
  std::string study;  ///< a cell_test whose limit state is wanted; empty: at rest
  /// "10x8" cells; "60 mm x 40 mm", a rectangle; "50 mm", a circle of this diameter; or a CSV file with the corners of
  /// a polygon, with columns such as "x [mm]" and "y [mm]". Elements with their origins inside belong to it.
  std::string outline = "3x3";
  double tolerance = 2e-5;      ///< of chords [m]
  double minimumClearance = 0;  ///< between elements [m]
};

struct PatchReport {
  int elements = 0;
  int leftOut = 0;  ///< inside the outline, but not linked to the rest
  long triangles = 0;
  double clearance = 0;  ///< between elements of the material, exact [m]
  double deviation = 0;  ///< of the meshes from the exact surfaces, at the middles of edges and triangles [m]
  /// Where meshes go across an opening within one element that is narrower than half of its thinnest wire: how far they
  /// are from its walls; 0 if they do so nowhere [m].
  double filled = 0;
  double volume = 0;                               ///< of all elements [m³]
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of a box around it [m]
  bool cancelled = false;                          ///< there is no file
};

/// Whether a scene describes nothing but interlocking cells, so that its export is a patch.
bool isFabric(const Scene& scene);

/// What an export would take: `elements`, `leftOut` and `clearance`, before any mesh is made. Throws as exportPatch
/// does, but for a clearance below the minimum.
PatchReport inspectPatch(const Scene& scene, const PatchRequest& request, base::ExecutionContext& context);

/// Writes one closed mesh for each element; of STL and 3MF files, lengths are in millimetres and the patch lies at the
/// origin's side where all coordinates are positive. Throws base::InputError: an outline that cannot be read, no
/// element inside, a clearance below the minimum, a study that is no cell_test or finds no limit.
PatchReport exportPatch(const Scene& scene, const PatchRequest& request, const std::filesystem::path& file,
                        base::ExecutionContext& context);

}  // namespace pliant::scene
