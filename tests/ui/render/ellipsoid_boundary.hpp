#pragma once

#include <cmath>
#include <memory>

#include "core/interlock/sphere_mesh.hpp"
#include "core/scene/boundary_surface.hpp"

namespace pliant::render {

/// A boundary of closed form: an ellipsoid about `middle` with these semi-axes, coloured by the distance.
inline std::shared_ptr<scene::BoundarySurface> ellipsoidBoundary(const Eigen::Vector3d& axes,
                                                                 const Eigen::Vector3d& middle) {
  const interlock::SphereMesh sphere = interlock::icosphere(3);
  auto surface = std::make_shared<scene::BoundarySurface>();
  const auto count = static_cast<Eigen::Index>(sphere.directions.size());
  surface->name = "ellipsoid";
  surface->points.resize(3, count);
  surface->triangles = sphere.triangles;
  surface->known.assign(sphere.directions.size(), true);
  scene::BoundaryQuantity distance{
      "distance", "distance from\nthe middle", scene::BoundaryQuantity::Kind::coordinate, {}};
  scene::BoundaryQuantity way{"way", "how the limit\nwas reached", scene::BoundaryQuantity::Kind::way, {}};
  distance.values.resize(count);
  way.values.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d& direction = sphere.directions[static_cast<std::size_t>(i)];
    surface->points.col(i) = middle + axes.cwiseProduct(direction);
    distance.values[i] = axes.cwiseProduct(direction).norm();
    way.values[i] = direction.z() > 0.8 ? 2 : direction.z() > 0.3 ? 1 : 0;
  }
  surface->quantities = {distance, way};
  return surface;
}

}  // namespace pliant::render
