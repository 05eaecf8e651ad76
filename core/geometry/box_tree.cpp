#include "core/geometry/box_tree.hpp"

#include <algorithm>

#include "core/math/parallel.hpp"

namespace pliant::geometry {

namespace {

constexpr int runLength = 8;     // boxes under one node of the lowest level
constexpr int runsOfChunk = 32;  // searched by one thread at a time

int countRuns(int count, int length) { return (count + length - 1) / length; }

/// The lowest 21 bits of `value`, moved apart so that two zeros stand between them.
std::uint64_t spreadBits(std::uint64_t value) {
  value = (value | value << 32) & 0x1f00000000ffff;
  value = (value | value << 16) & 0x1f0000ff0000ff;
  value = (value | value << 8) & 0x100f00f00f00f00f;
  value = (value | value << 4) & 0x10c30c30c30c30c3;
  return (value | value << 2) & 0x1249249249249249;
}

/// Eigen's intersects() copies the corners; this runs in the innermost loop.
bool overlap(const BoxTree::Box& a, const BoxTree::Box& b) {
  return a.min().x() <= b.max().x() && b.min().x() <= a.max().x() && a.min().y() <= b.max().y() &&
         b.min().y() <= a.max().y() && a.min().z() <= b.max().z() && b.min().z() <= a.max().z();
}

}  // namespace

void BoxTree::sortBoxes(std::span<const Box> boxes) {
  Box centres;
  for (const Box& box : boxes)
    if (!box.isEmpty()) centres.extend(box.center());
  // One scale for all axes keeps runs compact in flat or long scenes.
  constexpr double cells = (1 << 21) - 1;
  const double extent = centres.isEmpty() ? 0 : centres.sizes().maxCoeff();
  const double scale = extent > 0 ? cells / extent : 0;
  codes_.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::uint64_t code = 0;
    if (!boxes[i].isEmpty()) {
      const Eigen::Vector3d place = (boxes[i].center() - centres.min()) * scale;
      for (int axis = 0; axis < 3; ++axis) {
        const double cell = place[axis] > 0 ? std::min(place[axis], cells) : 0;
        code |= spreadBits(static_cast<std::uint64_t>(cell)) << axis;
      }
    }
    codes_[i] = {code, static_cast<int>(i)};
  }
  std::sort(codes_.begin(), codes_.end());
}

void BoxTree::build(std::span<const Box> boxes) {
  sortBoxes(boxes);
  const int count = static_cast<int>(boxes.size());
  order_.resize(count);
  boxes_.resize(count);
  for (int place = 0; place < count; ++place) {
    order_[place] = codes_[place].second;
    boxes_[place] = boxes[order_[place]];
  }
  std::size_t level = 0;
  for (int children = count, width = runLength; children > 1 || level == 0; width = 2, ++level) {
    if (levels_.size() <= level) levels_.emplace_back();
    const std::vector<Box>& below = level == 0 ? boxes_ : levels_[level - 1];
    std::vector<Box>& nodes = levels_[level];
    nodes.assign(countRuns(children, width), Box());
    for (int child = 0; child < children; ++child) nodes[child / width].extend(below[child]);
    children = static_cast<int>(nodes.size());
  }
  levels_.resize(level);
}

void BoxTree::findPairsOfRun(int run, const BoxTree& other, const Filter& wanted, Pairs& pairs) const {
  struct Node {
    int level, index;
  };
  const bool own = &other == this;
  const Box& bounds = levels_[0][run];
  std::array<Node, 64> stack;  // at most one node a level waits besides the one being opened
  int depth = 0;
  stack[depth++] = {static_cast<int>(other.levels_.size()) - 1, 0};
  while (depth > 0) {
    const auto [level, index] = stack[--depth];
    if (own && ((index + 1L) << level) <= run) continue;  // runs before this one have met it already
    if (!overlap(other.levels_[level][index], bounds)) continue;
    if (level > 0) {
      const int children = static_cast<int>(other.levels_[level - 1].size());
      for (const int child : {2 * index + 1, 2 * index})
        if (child < children) stack[depth++] = {level - 1, child};
      continue;
    }
    const int end = std::min(size(), (run + 1) * runLength);
    const int otherEnd = std::min(other.size(), (index + 1) * runLength);
    for (int i = run * runLength; i < end; ++i) {
      if (!overlap(boxes_[i], other.levels_[0][index])) continue;
      for (int j = own && index == run ? i + 1 : index * runLength; j < otherEnd; ++j) {
        if (!overlap(boxes_[i], other.boxes_[j])) continue;
        int first = order_[i], second = other.order_[j];
        if (own && first > second) std::swap(first, second);
        if (wanted(first, second)) pairs.push_back({first, second});
      }
    }
  }
}

BoxTree::Pairs BoxTree::findPairs(const BoxTree& other, const Filter& wanted) const {
  if (size() == 0 || other.size() == 0) return {};
  const int runs = static_cast<int>(levels_[0].size()), chunks = countRuns(runs, runsOfChunk);
  std::vector<Pairs> found(chunks);
  math::parallelFor(chunks, [&](int chunk) {
    const int end = std::min(runs, (chunk + 1) * runsOfChunk);
    for (int run = chunk * runsOfChunk; run < end; ++run) findPairsOfRun(run, other, wanted, found[chunk]);
  });
  std::size_t count = 0;
  for (const Pairs& pairs : found) count += pairs.size();
  Pairs all;
  all.reserve(count);
  for (const Pairs& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  return all;
}

BoxTree::Pairs BoxTree::pairsWith(const BoxTree& other, const Filter& wanted) const {
  if (&other != this) return findPairs(other, wanted);
  return findPairs(BoxTree(other), wanted);  // every pair in both orders, and each box with itself
}

BoxTree::Pairs BoxTree::ownPairs(const Filter& wanted) const { return findPairs(*this, wanted); }

}  // namespace pliant::geometry
