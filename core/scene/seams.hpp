#pragma once

#include <vector>

#include "core/scene/placed_geometry.hpp"

namespace pliant::scene {

/// Sews geometries together along the scene's "seams" (normalised): nodes that are sewn become one, counted where the
/// first of them was, and start in the middle of all of them; nodes after it are counted anew. Throws base::InputError
/// with a JSON pointer as location.
void sewSeams(const Json& seams, std::vector<PlacedGeometry>& geometries);

}  // namespace pliant::scene
