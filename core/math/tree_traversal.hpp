#pragma once

#include <functional>
#include <vector>

namespace pliant::math {

/// Visits the nodes of a forest, each after all its children or after its parent. Nodes are numbered children first;
/// `parent` is -1 at roots.
class TreeTraversal {
 public:
  explicit TreeTraversal(const std::vector<int>& parent);

  /// Spread over as many threads as setThreadCount allows. `prepare` is called first, with the number of slots.
  void childrenFirst(const std::function<void(int slotCount)>& prepare,
                     const std::function<void(int node)>& visit) const;
  void parentsFirst(const std::function<void(int node)>& visit) const;

  /// Within a visit, and within a parallelFor of it: a number below the number of slots that no other thread at work
  /// has.
  static int slot();

 private:
  std::vector<int> parent_;
  std::vector<int> childStarts_;
  std::vector<int> children_;
};

}  // namespace pliant::math
