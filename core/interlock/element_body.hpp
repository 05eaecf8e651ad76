#pragma once

#include "core/geometry/implicit_surface.hpp"
#include "core/interlock/element_parts.hpp"

namespace pliant::interlock {

/// An element as a solid body: the union of its pieces, known exactly by its distance.
class ElementBody {
 public:
  /// The shape must have passed checkShape.
  explicit ElementBody(const ElementShape& shape);

  /// In the shape's coordinates [m].
  geometry::SurfacePlace at(const Eigen::Vector3d& place) const;

  /// The body's surface as one closed manifold mesh, with chords within `tolerance` [m] of it; of a single mesh that is
  /// not dilated, that mesh. Throws base::InputError
  /// (location empty) if the pieces do not hang together, or are too thin for the size of the element.
  geometry::BodyMesh mesh(double tolerance) const;

 private:
  std::string name_;
  double halfThickness_;  ///< of the thinnest piece [m]
  ElementParts parts_;
  std::vector<geometry::SurfaceMesh> solids_;  ///< the pieces that are closed meshes
  bool isPlainMesh_;                           ///< one mesh that is not dilated
};

}  // namespace pliant::interlock
