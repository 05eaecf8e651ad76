#include "core/math/supernode_tree.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pliant::math {

namespace {

double countFlops(double p, double r) { return 2.0 / 3 * p * p * p + 2 * p * p * r + 2 * p * r * r; }

/// Parent of every vertex in the elimination tree, -1 at a root (Liu 1990). Vertices are numbered by elimination.
std::vector<int> eliminationTree(const std::vector<std::vector<int>>& earlier) {
  const int count = static_cast<int>(earlier.size());
  std::vector<int> parent(count, -1);
  std::vector<int> ancestor(count, -1);
  for (int v = 0; v < count; ++v) {
    for (int u : earlier[v]) {
      while (ancestor[u] != -1 && ancestor[u] != v) u = std::exchange(ancestor[u], v);
      if (ancestor[u] == -1) ancestor[u] = parent[u] = v;
    }
  }
  return parent;
}

/// For every vertex the later vertices that it is coupled to in the factors, ascending.
std::vector<std::vector<int>> columnStructures(const std::vector<std::vector<int>>& later,
                                               const std::vector<int>& parent) {
  std::vector<std::vector<int>> structure = later;
  std::vector<int> united;
  for (std::size_t v = 0; v < structure.size(); ++v) {  // children come before their parents
    if (parent[v] < 0) continue;
    std::vector<int>& above = structure[parent[v]];
    united.clear();
    std::set_union(
        above.begin(), above.end(), structure[v].begin() + 1, structure[v].end(), std::back_inserter(united));
    above.assign(united.begin(), united.end());
  }
  return structure;
}

/// A supernode while supernodes are merged: named by its last pivot.
struct Group {
  std::vector<int> pivots;
  std::vector<int> children;
  int p = 0;
  int r = 0;
  double work = 0;
};

/// Merges children into `group` as long as the estimated work falls, the best first.
void mergeChildren(std::vector<Group>& groups, Group& group, SupernodeTree::WorkEstimate estimateWork) {
  while (true) {
    double bestGain = 0;
    std::size_t best = 0;
    for (std::size_t c = 0; c < group.children.size(); ++c) {
      const Group& child = groups[group.children[c]];
      const double gain = group.work + child.work - estimateWork(group.p + child.p, group.r);
      if (gain > bestGain) {
        bestGain = gain;
        best = c;
      }
    }
    if (bestGain <= 0) return;
    Group child = std::move(groups[group.children[best]]);
    group.children.erase(group.children.begin() + static_cast<std::ptrdiff_t>(best));
    group.children.insert(group.children.end(), child.children.begin(), child.children.end());
    group.pivots.insert(group.pivots.end(), child.pivots.begin(), child.pivots.end());
    group.p += child.p;
    group.work = estimateWork(group.p, group.r);
  }
}

}  // namespace

// LAPACK's LU and triangular solves are slower in small blocks, so are products with few pivots, and every result of a
// product is scattered once. The constants are ratios of measured times.
double SupernodeTree::workOfLu(double p, double r) {
  return (2.0 / 3 * p * p + 2 * p * r) * (p + 100) + 2 * r * r * (p + 30) + 3e5;
}

SupernodeTree::SupernodeTree(const BlockPattern& pattern, const std::vector<int>& order, WorkEstimate estimateWork) {
  const int count = pattern.vertexCount();
  std::vector<int> place(count);
  for (int i = 0; i < count; ++i) place[order[i]] = i;
  std::vector<std::vector<int>> earlier(count);
  std::vector<std::vector<int>> later(count);
  for (int i = 0; i < count; ++i) {
    for (int k = pattern.starts[order[i]]; k < pattern.starts[order[i] + 1]; ++k) {
      const int j = place[pattern.neighbors[k]];
      (j < i ? earlier : later)[i].push_back(j);
    }
    std::sort(later[i].begin(), later[i].end());
  }
  const std::vector<int> parent = eliminationTree(earlier);
  const std::vector<std::vector<int>> structure = columnStructures(later, parent);

  std::vector<Group> groups(count);
  std::vector<int> roots;
  for (int i = 0; i < count; ++i) {
    Group& group = groups[i];
    group.pivots = {i};
    group.p = pattern.width(order[i]);
    for (const int j : structure[i]) group.r += pattern.width(order[j]);
    group.work = estimateWork(group.p, group.r);
    mergeChildren(groups, group, estimateWork);
    if (parent[i] < 0) {
      roots.push_back(i);
    } else {
      groups[parent[i]].children.push_back(i);
    }
  }

  // Groups leave the stack parents first; reversed, that is a postorder.
  std::vector<int> postorder;
  std::vector<int> stack = roots;
  while (!stack.empty()) {
    const int g = stack.back();
    stack.pop_back();
    postorder.push_back(g);
    stack.insert(stack.end(), groups[g].children.begin(), groups[g].children.end());
  }
  std::reverse(postorder.begin(), postorder.end());

  std::vector<int> newPlace(count);
  std::vector<int> supernodeOf(count, -1);
  int firstPivot = 0;
  for (std::size_t s = 0; s < postorder.size(); ++s) {
    Group& group = groups[postorder[s]];
    vertexBegin_.push_back(static_cast<int>(vertices_.size()));
    std::sort(group.pivots.begin(), group.pivots.end());
    for (const int i : group.pivots) {
      newPlace[i] = static_cast<int>(vertices_.size());
      supernodeOf[i] = static_cast<int>(s);
      vertices_.push_back(order[i]);
    }
    Supernode& node = supernodes.emplace_back();
    node.firstPivot = firstPivot;
    node.pivots = group.p;
    node.rows = group.r;
    node.work = group.work;
    firstPivot += group.p;
    work += group.work;
    flops += countFlops(group.p, group.r);
  }
  vertexBegin_.push_back(count);
  childCount.assign(postorder.size(), 0);
  for (std::size_t s = 0; s < postorder.size(); ++s) {
    const std::vector<int>& rows = structure[postorder[s]];
    std::vector<int>& places = rows_.emplace_back();
    for (const int j : rows) places.push_back(newPlace[j]);
    std::sort(places.begin(), places.end());
    if (rows.empty()) continue;
    supernodes[s].parent = supernodeOf[rows.front()];
    ++childCount[supernodes[s].parent];
  }
}

}  // namespace pliant::math
