#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/model.hpp"
#include "core/scene/parts_request.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// A scene in the shape in which it is to be made.
struct PartsSource {
  const Scene& scene;
  const mechanics::Model& model;  ///< of the scene; its point masses count
  mechanics::Vector positions;    ///< of all coordinates [m]
  /// The positions over a period, if there is a motion: links are laid in layers so that they do not meet at any of
  /// these either.
  std::vector<mechanics::Vector> motion;
};

/// One body to be made.
struct Part {
  std::string name;  ///< of the element, or elements, that it is made of
  geometry::SurfaceMesh mesh;
};

struct PartsReport {
  struct Entry {
    std::string name;
    long triangles = 0;
    double volume = 0;     ///< [m³]
    Eigen::Vector3d size;  ///< of a box around it [m]
  };
  std::vector<Entry> parts;
  Eigen::Vector3d size;              ///< of a box around all [m]
  std::vector<std::string> remarks;  ///< sentences about what was decided or left out
};

/// The bodies of a scene:
///  - shells and membranes, thickened by the sum of the thicknesses of the elements on them (geometry::thickenSurface);
///  - solids, by the faces that belong to one tetrahedron alone;
///  - links in the plane, those that rigid angles join being one, as plates with holes at their joints and where
///    springs are attached, laid in layers so that none meet (linkPlates);
///  - rods as wires with sockets for balls of the point masses at their nodes (rodWires).
/// Parts that share no node are apart. Each has passed geometry::checkSolid. None once cancelled. Throws
/// base::InputError if there is nothing to be made, or something cannot.
std::vector<Part> makeParts(const PartsSource& source, const PartsRequest& request, base::ExecutionContext& context,
                            std::vector<std::string>& remarks);

/// Writes them as STL, OBJ, PLY, glTF, glb or 3MF, by the extension. Of STL and 3MF files, lengths are in millimetres.
/// They lie at the origin's side where all coordinates are positive. None, and no file, once cancelled. Throws
/// base::InputError as above.
std::optional<PartsReport> exportParts(const PartsSource& source, const PartsRequest& request,
                                       const std::filesystem::path& file, base::ExecutionContext& context);

/// A line for each part and each remark, and one for all, which says what was checked.
std::vector<std::string> linesOf(const PartsReport& report);

}  // namespace pliant::scene
