#include "core/math/elimination_order.hpp"

#include <metis.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <random>
#include <tuple>

#include "core/math/parallel.hpp"

namespace pliant::math {

namespace {

constexpr int dissections = 2;
/// Smallest fill takes time with the cube of the vertices (10 ms at 260): as many tries as the numbers deserve.
int fillTries(int vertices) { return vertices <= 300 ? 4 : vertices <= 700 ? 1 : 0; }

/// The part of the pattern that takes part in the search, with its own numbers.
struct Graph {
  std::vector<int> vertices;  ///< their numbers in the pattern
  std::vector<idx_t> starts{0};
  std::vector<idx_t> neighbors;
  std::vector<idx_t> weights;

  Graph(const BlockPattern& pattern, std::vector<int> chosen) : vertices(std::move(chosen)) {
    std::vector<int> local(pattern.vertexCount(), -1);
    for (int i = 0; i < size(); ++i) local[vertices[i]] = i;
    for (const int v : vertices) {
      for (int k = pattern.starts[v]; k < pattern.starts[v + 1]; ++k) {
        if (local[pattern.neighbors[k]] >= 0) neighbors.push_back(local[pattern.neighbors[k]]);
      }
      starts.push_back(static_cast<idx_t>(neighbors.size()));
      weights.push_back(pattern.width(v));
    }
  }
  int size() const { return static_cast<int>(vertices.size()); }
};

std::vector<int> nestedDissection(Graph graph, int seed) {
  static std::mutex metisMutex;  // METIS keeps the state of its random numbers in the process
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = seed;
  options[METIS_OPTION_NSEPS] = 4;
  std::vector<idx_t> order(graph.size());
  std::vector<idx_t> places(graph.size());
  idx_t size = graph.size();
  const std::lock_guard lock(metisMutex);
  const int status = METIS_NodeND(&size, graph.starts.data(), graph.neighbors.data(), graph.weights.data(),
                                  options.data(), order.data(), places.data());
  if (status != METIS_OK) std::iota(order.begin(), order.end(), 0);
  return {order.begin(), order.end()};
}

/// A graph that vertices can be eliminated from: its rows of bits are the neighbours, and the vertex itself.
class EliminationGraph {
 public:
  explicit EliminationGraph(const Graph& graph)
      : weights_(graph.weights), words_((graph.size() + 63) / 64), bits_(graph.weights.size() * words_, 0) {
    for (int v = 0; v < graph.size(); ++v) {
      set(v, v);
      for (idx_t k = graph.starts[v]; k < graph.starts[v + 1]; ++k) set(v, graph.neighbors[k]);
    }
  }

  /// Entries that eliminating `v` would add to the rest, per column eliminated.
  double fill(int v) const {
    const std::uint64_t* near = row(v);
    double entries = 0;
    forEachBit([&](int w) { return near[w]; },
               [&](int a) {
                 const std::uint64_t* known = row(a);
                 double missing = 0;
                 forEachBit([&](int w) { return near[w] & ~known[w]; }, [&](int b) { missing += weights_[b]; });
                 entries += missing * weights_[a];
               });
    return entries / weights_[v];
  }

  /// Calls `changed` with every vertex whose fill may have changed.
  template <class Visit>
  void eliminate(int v, const Visit& changed) {
    clear(v, v);
    const std::vector<std::uint64_t> clique(row(v), row(v) + words_);
    std::vector<std::uint64_t> reached(words_, 0);
    forEachBit([&](int w) { return clique[w]; },
               [&](int a) {
                 clear(a, v);
                 for (int w = 0; w < words_; ++w) reached[w] |= row(a)[w] |= clique[w];
               });
    forEachBit([&](int w) { return reached[w]; }, changed);
  }

 private:
  template <class Word, class Visit>
  void forEachBit(const Word& word, const Visit& visit) const {
    for (int w = 0; w < words_; ++w) {
      for (std::uint64_t rest = word(w); rest != 0; rest &= rest - 1) visit(64 * w + std::countr_zero(rest));
    }
  }
  std::uint64_t* row(int v) { return bits_.data() + static_cast<std::size_t>(v) * words_; }
  const std::uint64_t* row(int v) const { return bits_.data() + static_cast<std::size_t>(v) * words_; }
  void set(int v, int u) { row(v)[u / 64] |= std::uint64_t{1} << (u % 64); }
  void clear(int v, int u) { row(v)[u / 64] &= ~(std::uint64_t{1} << (u % 64)); }

  std::vector<idx_t> weights_;
  int words_;
  std::vector<std::uint64_t> bits_;
};

/// Repeatedly eliminates the vertex that adds the fewest entries; the seed decides between equals.
std::vector<int> smallestFill(const Graph& graph, unsigned seed) {
  EliminationGraph rest(graph);
  std::mt19937 generator(seed);
  std::vector<std::tuple<double, std::uint32_t, int>> candidates;
  std::vector<int> order;
  for (int v = 0; v < graph.size(); ++v) candidates.emplace_back(rest.fill(v), generator(), v);
  std::vector<int> slot(graph.size());
  std::iota(slot.begin(), slot.end(), 0);
  while (!candidates.empty()) {
    const auto best = std::min_element(candidates.begin(), candidates.end());
    const int v = std::get<int>(*best);
    slot[std::get<int>(candidates.back())] = static_cast<int>(best - candidates.begin());
    *best = candidates.back();
    candidates.pop_back();
    order.push_back(v);
    rest.eliminate(v, [&](int a) { std::get<double>(candidates[slot[a]]) = rest.fill(a); });
  }
  return order;
}

}  // namespace

std::vector<std::vector<int>> eliminationOrders(const BlockPattern& pattern, OrderingEffort effort) {
  const int count = pattern.vertexCount();
  const double dense = std::max(16.0, 10 * std::sqrt(count));
  std::vector<int> sparse;
  std::vector<int> last;
  for (int v = 0; v < count; ++v) {
    (pattern.degree(v) == count - 1 || pattern.degree(v) > dense ? last : sparse).push_back(v);
  }
  if (sparse.empty()) return {last};
  const Graph graph(pattern, sparse);
  std::vector<std::vector<int>> orders(effort == OrderingEffort::quick ? 1 : dissections + fillTries(graph.size()));
  parallelFor(static_cast<int>(orders.size()), [&](int i) {
    const auto seed = static_cast<unsigned>(i);
    std::vector<int>& order = orders[i];
    order = i < dissections ? nestedDissection(graph, i) : smallestFill(graph, seed);
    for (int& v : order) v = graph.vertices[v];
    order.insert(order.end(), last.begin(), last.end());
  });
  return orders;
}

}  // namespace pliant::math
