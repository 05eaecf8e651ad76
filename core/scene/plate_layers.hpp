#pragma once

#include <optional>
#include <vector>

namespace pliant::scene {

/// What plates that lie in layers must keep.
struct LayerRules {
  /// A pin through some plates, and those that no layer between these may hold.
  struct Pin {
    std::vector<int> plates;
    std::vector<int> kept;
  };
  std::vector<std::vector<char>> apart;  ///< square: whether two plates must not share a layer
  std::vector<Pin> pins;
};

/// The layer of each plate, from 0, with as few layers as the search finds (it goes through all ways unless they are
/// too many); none if the pins cannot be kept.
std::optional<std::vector<int>> assignLayers(const LayerRules& rules);

}  // namespace pliant::scene
