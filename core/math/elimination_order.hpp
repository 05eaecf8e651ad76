#pragma once

#include <vector>

#include "core/math/block_pattern.hpp"

namespace pliant::math {

/// For how long the order will be in use.
enum class OrderingEffort {
  thorough,  ///< for a matrix that is factorised many times
  quick      ///< for one whose pattern changes soon: one dissection only
};

/// Orders in which to eliminate the vertices of `pattern` so that the factors fill in little: nested dissections of the
/// graph (George 1973) by METIS (Karypis & Kumar 1998), and for small graphs greedy smallest fill (Tinney & Walker
/// 1967, weighted by the widths) with several ways to break ties, which is up to twice as good there. Vertices coupled
/// to nearly all others, such as the border of a continuation step, come last. Which order is best depends on the mesh:
/// the caller compares their costs.
std::vector<std::vector<int>> eliminationOrders(const BlockPattern& pattern,
                                                OrderingEffort effort = OrderingEffort::thorough);

}  // namespace pliant::math
