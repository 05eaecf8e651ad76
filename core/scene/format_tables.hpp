#pragma once

#include <string>

namespace pliant::scene {

/// The reference part of scenes/README.md in Markdown, made from `sceneSpec()`: a table of keys for every object.
std::string formatTables();

}  // namespace pliant::scene
