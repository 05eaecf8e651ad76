#pragma once

#include "core/cloth/cloth_problem.hpp"
#include "core/mechanics/shell.hpp"
#include "core/scene/placed_geometry.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// The cloth of a scene whose model is `model`: limits, pins, bodies, wind and contact. Of its model's coordinates only
/// those are locked that "locked" locks. Throws base::InputError with the scene's name and a JSON pointer as location.
std::shared_ptr<const cloth::ClothProblem> buildClothProblem(const Scene& scene,
                                                             std::shared_ptr<const mechanics::Model> model);

/// Where the triangles of a geometry rest: corner i of triangle t at `positions` (3 an entry [m]) of triangles[t][i].
struct RestShape {
  mechanics::Vector positions;
  mechanics::Triangles triangles;
};

/// The rest shape of one element: its "pattern", or its geometry as it is before seams are closed. Two triangles share
/// a corner at rest where their node is one and rests in one place; edges that they do not share are seams. Throws
/// base::InputError if the pattern does not fit the geometry.
RestShape restShapeOf(const Json& element, const std::string& pointer, const PlacedGeometry& geometry,
                      const std::filesystem::path& directory);

}  // namespace pliant::scene
