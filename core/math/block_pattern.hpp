#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace pliant::math {

/// The pattern of a square sparse matrix, coarsened: neighbouring columns with the same entries are one *vertex*. A
/// Jacobian of harmonic balance has a vertex a mesh node (3 coordinates with 2H+1 coefficients each), so that ordering
/// and symbolic analysis work on a graph of the size of the mesh.
struct BlockPattern {
  std::vector<int> firstColumn;     ///< per vertex, and the matrix's size at the end
  std::vector<int> vertexOfColumn;  ///< per column
  std::vector<int> starts;          ///< per vertex, and the end: where its neighbours begin
  std::vector<int> neighbors;       ///< in the graph of A + Aᵀ, ascending, without the vertex itself

  explicit BlockPattern(const Eigen::SparseMatrix<double>& matrix);
  /// `vertices` of `width` columns each, coupled as `pairs` say (in any order, repeated or not).
  BlockPattern(int vertices, int width, const std::vector<std::array<int, 2>>& pairs);

  int vertexCount() const { return static_cast<int>(firstColumn.size()) - 1; }
  int width(int vertex) const { return firstColumn[vertex + 1] - firstColumn[vertex]; }
  int degree(int vertex) const { return starts[vertex + 1] - starts[vertex]; }
};

}  // namespace pliant::math
