#include "core/math/block_pattern.hpp"

#include <algorithm>

namespace pliant::math {

namespace {

void listNeighbors(std::vector<std::vector<int>>& adjacency, BlockPattern& pattern) {
  pattern.starts.push_back(0);
  for (auto& list : adjacency) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    pattern.neighbors.insert(pattern.neighbors.end(), list.begin(), list.end());
    pattern.starts.push_back(static_cast<int>(pattern.neighbors.size()));
  }
}

}  // namespace

BlockPattern::BlockPattern(const Eigen::SparseMatrix<double>& matrix) : vertexOfColumn(matrix.cols()) {
  const int size = static_cast<int>(matrix.cols());
  const int* columnStarts = matrix.outerIndexPtr();
  const int* rows = matrix.innerIndexPtr();
  for (int j = 0; j < size; ++j) {
    const bool same = j > 0 && std::equal(rows + columnStarts[j - 1], rows + columnStarts[j], rows + columnStarts[j],
                                          rows + columnStarts[j + 1]);
    if (!same) firstColumn.push_back(j);
    vertexOfColumn[j] = static_cast<int>(firstColumn.size()) - 1;
  }
  firstColumn.push_back(size);

  std::vector<std::vector<int>> adjacency(vertexCount());
  for (int v = 0; v < vertexCount(); ++v) {
    int previous = -1;
    for (int k = columnStarts[firstColumn[v]]; k < columnStarts[firstColumn[v] + 1]; ++k) {
      const int u = vertexOfColumn[rows[k]];
      if (u == previous || u == v) continue;
      previous = u;
      adjacency[u].push_back(v);
      adjacency[v].push_back(u);
    }
  }
  listNeighbors(adjacency, *this);
}

BlockPattern::BlockPattern(int vertices, int width, const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::vector<int>> adjacency(vertices);
  for (const auto& [a, b] : pairs) {
    if (a == b) continue;
    adjacency[a].push_back(b);
    adjacency[b].push_back(a);
  }
  for (int v = 0; v <= vertices; ++v) firstColumn.push_back(v * width);
  for (int v = 0; v < vertices; ++v) vertexOfColumn.insert(vertexOfColumn.end(), width, v);
  listNeighbors(adjacency, *this);
}

}  // namespace pliant::math
