#pragma once

#include <string>
#include <vector>

#include "core/mechanics/model.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

/// These nodes and those that rest nearest to their mirror images in a plane ("point" and "normal"), ascending and each
/// once. Throws base::InputError at `pointer` for a normal of no length, and for a node off the plane without a node on
/// the other side of it where its image would be nearest.
std::vector<int> withMirrorImages(const mechanics::Model& model, const std::vector<int>& nodes, const Json& plane,
                                  const std::string& pointer);

}  // namespace pliant::scene
