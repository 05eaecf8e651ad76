#pragma once

#include <string>
#include <vector>

#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"

namespace pliant::document {

/// The kinds of entry that can be added to one of a scene's lists, such as "springs": the types of its entries, or the
/// one name of an entry where all are alike. Empty for what is no such list, and for what only a file can give.
std::vector<std::string> entryTypes(const std::string& list);

/// A new entry of this kind that fits into the scene: a name that is free, the given node where it needs one, sizes
/// and frequencies like those that are there, plain values for all else. `model` is that of the scene.
scene::Json defaultEntry(const scene::Scene& scene, const mechanics::Model& model, const std::string& list,
                         const std::string& type, int node);

/// Adds to the scene as it is written what makes a new geometry move: an element like the last one on its triangles, or
/// a mass on each of its points. A geometry of which nothing has mass is refused.
void addBodyOf(scene::Json& written, const scene::Json& geometry, int dimension);

/// The scene as it is written, with every reference to the one entry of `list` that was left out written down: what
/// a second entry would make ambiguous.
scene::Json withReferencesWritten(const scene::Scene& scene, const std::string& list);

/// The scene as it is written, without the entry at `index` of `list` and, if that is a study, without the values that
/// are expected of it.
scene::Json withoutEntry(const scene::Scene& scene, const std::string& list, std::size_t index);

/// A copy of the entry at `index` of a list, with a name that is free.
scene::Json copiedEntry(const scene::Json& list, std::size_t index);

}  // namespace pliant::document
