#pragma once

#include <string>
#include <vector>

#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// One entry of the scene's "geometry", checked, put in its place, with its nodes counted through the scene.
struct PlacedGeometry {
  std::string name;
  int firstNode = 0;
  geometry::SurfaceMesh mesh;  ///< node indices within this geometry; `points` in place [m]

  int nodeCount() const { return static_cast<int>(mesh.points.cols()); }
  std::vector<std::array<int, 3>> globalTriangles() const;
};

/// All geometry of a normalised scene. Throws base::InputError with a JSON pointer as location.
std::vector<PlacedGeometry> placeGeometry(const Scene& scene);

/// The nodes that a selection (normalised, at `pointer`) means, ascending, counted through the scene.
/// Throws base::InputError if there is none.
std::vector<int> selectNodes(const Json& selection, const std::string& pointer,
                             const std::vector<PlacedGeometry>& geometries);

/// The same where exactly one node is wanted.
int selectNode(const Json& selection, const std::string& pointer, const std::vector<PlacedGeometry>& geometries);

}  // namespace pliant::scene
