#include "core/math/residual.hpp"

#include <algorithm>
#include <vector>

#include "core/math/parallel.hpp"

namespace pliant::math {

namespace {

/// Sums are split in this many parts whatever the threads, so that rounding does not depend on them.
constexpr int partCount = 8;
constexpr Eigen::Index smallMatrix = 20000;  ///< entries: not worth splitting

/// y -= A x over the columns of the vertices begin .. end-1.
void subtractColumns(const Eigen::SparseMatrix<double>& matrix, const BlockPattern& pattern, int begin, int end,
                     const double* x, double* y) {
  Eigen::VectorXd sum;
  for (int v = begin; v < end; ++v) {
    const int first = matrix.outerIndexPtr()[pattern.firstColumn[v]];
    const int height = matrix.outerIndexPtr()[pattern.firstColumn[v] + 1] - first;
    const Eigen::Map<const Eigen::MatrixXd> block(matrix.valuePtr() + first, height, pattern.width(v));
    sum.noalias() = block * Eigen::Map<const Eigen::VectorXd>(x + pattern.firstColumn[v], pattern.width(v));
    const int* rows = matrix.innerIndexPtr() + first;
    for (int k = 0; k < height; ++k) y[rows[k]] -= sum[k];
  }
}

/// y -= Aᵀ x in the rows of y that belong to the vertices begin .. end-1.
void subtractRows(const Eigen::SparseMatrix<double>& matrix, const BlockPattern& pattern, int begin, int end,
                  const double* x, double* y) {
  Eigen::VectorXd gathered;
  for (int v = begin; v < end; ++v) {
    const int first = matrix.outerIndexPtr()[pattern.firstColumn[v]];
    const int height = matrix.outerIndexPtr()[pattern.firstColumn[v] + 1] - first;
    const Eigen::Map<const Eigen::MatrixXd> block(matrix.valuePtr() + first, height, pattern.width(v));
    const int* rows = matrix.innerIndexPtr() + first;
    gathered.resize(height);
    for (int k = 0; k < height; ++k) gathered[k] = x[rows[k]];
    Eigen::Map<Eigen::VectorXd>(y + pattern.firstColumn[v], pattern.width(v)).noalias() -= block.transpose() * gathered;
  }
}

}  // namespace

Eigen::MatrixXd residual(const Eigen::SparseMatrix<double>& matrix, const BlockPattern& pattern, bool transposed,
                         const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) {
  const int vertices = pattern.vertexCount();
  const int columns = static_cast<int>(b.cols());
  const int parts = matrix.nonZeros() <= smallMatrix ? 1 : partCount;
  const auto partBegin = [&](int part) { return static_cast<int>(static_cast<long long>(vertices) * part / parts); };
  Eigen::MatrixXd result = b;
  if (transposed) {
    parallelFor(parts * columns, [&](int i) {
      const int part = i % parts;
      const int column = i / parts;
      subtractRows(
          matrix, pattern, partBegin(part), partBegin(part + 1), x.col(column).data(), result.col(column).data());
    });
    return result;
  }
  if (parts == 1) {
    for (int j = 0; j < columns; ++j)
      subtractColumns(matrix, pattern, 0, vertices, x.col(j).data(), result.col(j).data());
    return result;
  }
  Eigen::MatrixXd products(b.rows(), parts);
  for (int j = 0; j < columns; ++j) {
    parallelFor(parts, [&](int part) {
      products.col(part).setZero();
      subtractColumns(
          matrix, pattern, partBegin(part), partBegin(part + 1), x.col(j).data(), products.col(part).data());
    });
    result.col(j) += products.rowwise().sum();
  }
  return result;
}

}  // namespace pliant::math
