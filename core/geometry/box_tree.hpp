#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace pliant::geometry {

/// A hierarchy of axis-aligned boxes that finds those that overlap. It sorts the boxes along a Z-order curve and bounds
/// runs of them, so building takes the time of a sort (Lauterbach et al. 2009, "Fast BVH construction on GPUs").
/// Everything it returns depends on the boxes alone, not on the number of threads.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;  ///< a box that touches another overlaps it; an empty one, or one with NaN, does not
  using Pairs = std::vector<std::array<int, 2>>;
  /// Whether a pair is wanted; may be called from several threads at once.
  using Filter = std::function<bool(int, int)>;

  BoxTree() = default;
  explicit BoxTree(std::span<const Box> boxes) { build(boxes); }

  /// Forgets the boxes before. Keeps its memory.
  void build(std::span<const Box> boxes);
  int size() const { return static_cast<int>(order_.size()); }

  /// Of all pairs (i, j), i a box of this tree and j one of `other`, those that overlap and pass the filter, each once.
  Pairs pairsWith(const BoxTree& other, const Filter& wanted) const;
  /// Of all pairs i < j of this tree, those that overlap and pass the filter, each once.
  Pairs ownPairs(const Filter& wanted) const;

 private:
  void sortBoxes(std::span<const Box> boxes);
  Pairs findPairs(const BoxTree& other, const Filter& wanted) const;
  void findPairsOfRun(int run, const BoxTree& other, const Filter& wanted, Pairs& pairs) const;

  std::vector<std::pair<std::uint64_t, int>> codes_;  ///< place on the curve and box
  std::vector<int> order_;                            ///< place -> box
  std::vector<Box> boxes_;                            ///< by place
  /// levels_[0] bounds runs of boxes that follow one another; node n of level k + 1 bounds 2n and 2n + 1 of level k.
  std::vector<std::vector<Box>> levels_;
};

}  // namespace pliant::geometry
