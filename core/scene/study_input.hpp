#pragma once

#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Where the options of a study stand, for error messages: "SCENE: /studies/2".
std::string placeOfStudy(const Scene& scene, const Json& options);

/// The index in `Model::parameters` of the parameter named by an entry of `list`. Throws base::InputError at
/// `place`/ENTRY if there is none, or if it stands before in the list.
int parameterNamed(const mechanics::Model& model, const Json& list, std::size_t entry, const std::string& place);

}  // namespace pliant::scene
