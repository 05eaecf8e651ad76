#include "core/math/block_pattern.hpp"

#include <algorithm>

namespace pliant::math {

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
  starts.push_back(0);
  for (auto& list : adjacency) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    neighbors.insert(neighbors.end(), list.begin(), list.end());
    starts.push_back(static_cast<int>(neighbors.size()));
  }
}

}  // namespace pliant::math
