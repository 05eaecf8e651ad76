#include "ui/render/element_tints.hpp"

#include <algorithm>

namespace pliant::render {

std::vector<int> elementTints(const interlock::UnitCell& patch, int tints) {
  const std::size_t count = patch.elements.size();
  std::vector<std::vector<int>> linked(count);
  for (const interlock::Link& link : patch.links) {
    linked[static_cast<std::size_t>(link.a)].push_back(link.b);
    linked[static_cast<std::size_t>(link.b)].push_back(link.a);
  }
  // Next the one that has the fewest tints left (Brelaz 1979): on lattices of triangles there is but one way.
  std::vector<int> chosen(count, -1);
  std::vector<std::vector<int>> uses(count, std::vector<int>(static_cast<std::size_t>(tints), 0));
  for (std::size_t step = 0; step < count; ++step) {
    std::size_t next = 0;
    std::ptrdiff_t most = -1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::ptrdiff_t taken = tints - std::count(uses[i].begin(), uses[i].end(), 0);
      if (chosen[i] < 0 && taken > most) next = i, most = taken;
    }
    chosen[next] = static_cast<int>(std::min_element(uses[next].begin(), uses[next].end()) - uses[next].begin());
    for (const int other : linked[next])
      ++uses[static_cast<std::size_t>(other)][static_cast<std::size_t>(chosen[next])];
  }
  return chosen;
}

}  // namespace pliant::render
