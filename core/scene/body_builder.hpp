#pragma once

#include "core/mechanics/contact_body.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Of an entry with a "path".
std::vector<mechanics::Keyframe> motionOf(const Json& entry);

/// The scene's "bodies". Throws base::InputError with a JSON pointer as location.
std::vector<mechanics::Body> buildBodies(const Scene& scene);

}  // namespace pliant::scene
