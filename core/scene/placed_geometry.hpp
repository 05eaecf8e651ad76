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
  /// Of the scene, for each of its own. Those from `firstNode` on, `ownCount` of them, belong to it; others, to which
  /// it is sewn, to geometries before it.
  std::vector<int> nodes;
  int firstNode = 0;
  int ownCount = 0;
  Eigen::Matrix3Xd unsewn;  ///< its nodes in place, before seams were closed [m]
  // Node indices are counted within this geometry; `points` are in place [m].
  geometry::SurfaceMesh mesh;
  std::vector<std::array<int, 2>> segments;
  std::vector<std::array<int, 4>> tetrahedra;

  int nodeCount() const { return static_cast<int>(mesh.points.cols()); }
  /// The same elements with nodes counted through the scene.
  template <std::size_t corners>
  std::vector<std::array<int, corners>> global(std::vector<std::array<int, corners>> elements) const {
    for (auto& element : elements)
      for (int& node : element) node = nodes[static_cast<std::size_t>(node)];
    return elements;
  }
};

/// All geometry of a normalised scene, sewn together. Throws base::InputError with a JSON pointer as location.
std::vector<PlacedGeometry> placeGeometry(const Scene& scene);

/// The nodes that a selection (normalised, at `pointer`) means, ascending, counted through the scene.
/// Throws base::InputError if there is none.
std::vector<int> selectNodes(const Json& selection, const std::string& pointer,
                             const std::vector<PlacedGeometry>& geometries);

/// The same where exactly one node is wanted.
int selectNode(const Json& selection, const std::string& pointer, const std::vector<PlacedGeometry>& geometries);

}  // namespace pliant::scene
