#include "core/math/tree_traversal.hpp"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>

#include "core/math/parallel.hpp"

namespace pliant::math {

TreeTraversal::TreeTraversal(const std::vector<int>& parent)
    : parent_(parent), childStarts_(parent.size() + 1, 0), children_(parent.size()) {
  const int count = static_cast<int>(parent.size());
  for (const int p : parent) {
    if (p >= 0) ++childStarts_[p + 1];
  }
  for (int node = 0; node < count; ++node) childStarts_[node + 1] += childStarts_[node];
  std::vector<int> next(childStarts_.begin(), childStarts_.end() - 1);
  for (int node = 0; node < count; ++node) {
    if (parent[node] >= 0) children_[next[parent[node]]++] = node;
  }
}

void TreeTraversal::childrenFirst(const std::function<void(int slotCount)>& prepare,
                                  const std::function<void(int node)>& visit) const {
  const int count = static_cast<int>(parent_.size());
  std::vector<std::atomic<int>> waiting(parent_.size());
  for (int node = 0; node < count; ++node) waiting[node] = childStarts_[node + 1] - childStarts_[node];
  // An arena of its own keeps a thread that waits here from starting unrelated work of the caller.
  tbb::task_arena arena(threadCount());
  arena.execute([&] {
    prepare(arena.max_concurrency());
    tbb::task_group group;
    const auto climb = [&](int node) {
      do {
        visit(node);
        node = parent_[node];
      } while (node >= 0 && --waiting[node] == 0);
    };
    for (int node = 0; node < count; ++node) {
      if (childStarts_[node] == childStarts_[node + 1]) group.run([&climb, node] { climb(node); });
    }
    group.wait();
  });
}

void TreeTraversal::parentsFirst(const std::function<void(int node)>& visit) const {
  tbb::task_arena arena(threadCount());
  arena.execute([&] {
    tbb::task_group group;
    std::function<void(int)> descend = [&](int node) {
      while (true) {
        visit(node);
        const int begin = childStarts_[node];
        const int end = childStarts_[node + 1];
        if (begin == end) return;
        for (int k = begin + 1; k < end; ++k) group.run([&descend, child = children_[k]] { descend(child); });
        node = children_[begin];
      }
    };
    for (int node = static_cast<int>(parent_.size()) - 1; node >= 0; --node) {
      if (parent_[node] < 0) group.run([&descend, node] { descend(node); });
    }
    group.wait();
  });
}

int TreeTraversal::slot() { return tbb::this_task_arena::current_thread_index(); }

}  // namespace pliant::math
