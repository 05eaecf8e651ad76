#pragma once

#include "core/cloth/cloth_problem.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/placed_geometry.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// The cloth of a scene whose model is `model`: limits, pins, bodies, wind and contact. Of its model's coordinates only
/// those are locked that "locked" locks. Throws base::InputError with the scene's name and a JSON pointer as location.
std::shared_ptr<const cloth::ClothProblem> buildClothProblem(const Scene& scene,
                                                             std::shared_ptr<const mechanics::Model> model);

/// The positions of all nodes with those of one element's geometry replaced by its "pattern", if it has one.
/// Throws base::InputError if the pattern does not fit the geometry.
mechanics::Vector restShapeOf(const Json& element, const std::string& pointer, const PlacedGeometry& geometry,
                              const std::filesystem::path& directory, const mechanics::Vector& positions);

}  // namespace pliant::scene
