#include "core/interlock/shared_lattice.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace pliant::interlock {

namespace {

std::vector<Link> sortedLinks(const UnitCell& cell) {
  std::vector<Link> links;
  for (const Link& link : cell.links) links.push_back(canonical(link));
  std::sort(links.begin(), links.end());
  return links;
}

void requireShared(const UnitCell& first, const UnitCell& other) {
  constexpr double rounding = 1e-9;
  if ((first.lattice - other.lattice).norm() > rounding * first.lattice.norm() ||
      first.elements.size() != other.elements.size() || sortedLinks(first) != sortedLinks(other))
    throw base::InputError("", "The materials '" + first.name + "' and '" + other.name +
                                   "' have no lattice with the same links in common, so their elements cannot hold "
                                   "each other.");
}

}  // namespace

UnitCell sharedLattice(const std::vector<UnitCell>& materials) {
  UnitCell shared;
  shared.name = materials.front().name;
  shared.lattice = materials.front().lattice;
  const int count = static_cast<int>(materials.front().elements.size());
  for (const UnitCell& material : materials) {
    requireShared(materials.front(), material);
    const int firstShape = static_cast<int>(shared.shapes.size());
    shared.shapes.insert(shared.shapes.end(), material.shapes.begin(), material.shapes.end());
    for (InterlockingElement element : material.elements) {
      element.shape += firstShape;
      shared.elements.push_back(element);
    }
  }
  const int alternatives = static_cast<int>(materials.size());
  for (const Link& link : materials.front().links)
    for (int a = 0; a < alternatives; ++a)
      for (int b = 0; b < alternatives; ++b) {
        Link own = link;
        own.a += a * count;
        own.b += b * count;
        shared.links.push_back(own);
      }
  return shared;
}

}  // namespace pliant::interlock
