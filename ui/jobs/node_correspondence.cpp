#include "ui/jobs/node_correspondence.hpp"

namespace pliant::jobs {

bool sameNodes(const mechanics::Model& a, const mechanics::Model& b) {
  return a.dimension == b.dimension && a.restPositions.size() == b.restPositions.size() &&
         a.restPositions == b.restPositions;
}

int correspondingNode(const mechanics::Model& from, int node, const mechanics::Model& to) {
  if (node < 0 || node >= from.nodeCount()) return -1;
  if (sameNodes(from, to)) return node;
  for (const auto& probe : from.probes) {
    if (probe.node != node) continue;
    for (const auto& other : to.probes)
      if (other.name == probe.name) return other.node;
  }
  return -1;
}

}  // namespace pliant::jobs
