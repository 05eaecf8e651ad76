#include "core/math/dense_kernels.hpp"

#include <cblas.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/math/parallel.hpp"

extern "C" void dgetrf_(const int* rows, const int* columns, double* a, const int* stride, int* pivots, int* info);

namespace pliant::math {

namespace {

constexpr int panelColumns = 96;
constexpr int updateColumns = 192;

double* at(double* a, int stride, int row, int column) {
  return a + static_cast<std::ptrdiff_t>(column) * stride + row;
}

void factorizePanel(int rows, int columns, double* a, int stride, int* swaps) {
  int info = 0;
  dgetrf_(&rows, &columns, a, &stride, swaps, &info);
  for (int i = 0; i < std::min(rows, columns); ++i) --swaps[i];  // LAPACK counts from 1
}

/// Calls `body(first column, how many)`. Exchanges in one column wait for one another; those in several do not.
template <class Body>
void forColumnGroups(int columns, double* x, int stride, const Body& body) {
  constexpr int groupColumns = 8;
  for (int j = 0; j < columns; j += groupColumns) body(at(x, stride, 0, j), std::min(groupColumns, columns - j));
}

void exchange(double* x, int stride, int columns, int row, int other) {
  if (row == other) return;
  for (int j = 0; j < columns; ++j) std::swap(*at(x, stride, row, j), *at(x, stride, other, j));
}

}  // namespace

void useOneBlasThread() {
  static const bool done = [] {
    openblas_set_num_threads(1);
    return true;
  }();
  (void)done;
}

void multiply(int rows, int columns, int inner, const double* a, int aStride, const double* b, int bStride, double* c,
              int cStride) {
  cblas_dgemm(
      CblasColMajor, CblasNoTrans, CblasNoTrans, rows, columns, inner, 1, a, aStride, b, bStride, 0, c, cStride);
}

void factorizeDense(int size, double* a, int stride, int* swaps) {
  if (size <= 2 * panelColumns) {
    factorizePanel(size, size, a, stride, swaps);
    return;
  }
  // Right-looking by panels. The first of the parallel updates brings the next panel up to date and factorises it, so
  // that no thread waits for panels.
  factorizePanel(size, panelColumns, a, stride, swaps);
  for (int k = 0; k + panelColumns < size; k += panelColumns) {
    const int next = k + panelColumns;
    const int afterNext = std::min(next + panelColumns, size);
    const int updates = 1 + (size - afterNext + updateColumns - 1) / updateColumns;
    parallelFor(updates, [&](int update) {
      const int begin = update == 0 ? next : afterNext + (update - 1) * updateColumns;
      const int end = update == 0 ? afterNext : std::min(begin + updateColumns, size);
      exchangeRows(panelColumns, swaps + k, end - begin, at(a, stride, k, begin), stride);
      solveTriangle(Triangle::unitLower, false, panelColumns, at(a, stride, k, k), stride, end - begin,
                    at(a, stride, k, begin), stride);
      subtractProduct(false, size - next, panelColumns, at(a, stride, next, k), stride, end - begin,
                      at(a, stride, k, begin), stride, at(a, stride, next, begin), stride);
      if (update == 0) factorizePanel(size - next, end - begin, at(a, stride, next, next), stride, swaps + next);
    });
  }
  const int panels = (size + panelColumns - 1) / panelColumns;
  parallelFor(panels - 1, [&](int panel) {
    for (int k = (panel + 1) * panelColumns; k < size; k += panelColumns) {
      exchangeRows(
          std::min(panelColumns, size - k), swaps + k, panelColumns, at(a, stride, k, panel * panelColumns), stride);
    }
  });
  for (int k = panelColumns; k < size; ++k) swaps[k] += k / panelColumns * panelColumns;
}

void exchangeRows(int size, const int* swaps, int columns, double* x, int stride) {
  forColumnGroups(columns, x, stride, [&](double* group, int width) {
    for (int i = 0; i < size; ++i) exchange(group, stride, width, i, swaps[i]);
  });
}

void exchangeRowsBack(int size, const int* swaps, int columns, double* x, int stride) {
  forColumnGroups(columns, x, stride, [&](double* group, int width) {
    for (int i = size - 1; i >= 0; --i) exchange(group, stride, width, i, swaps[i]);
  });
}

void solveTriangle(Triangle triangle, bool transposed, int size, const double* lu, int stride, int columns, double* x,
                   int xStride) {
  const auto part = triangle == Triangle::upper ? CblasUpper : CblasLower;
  const auto diagonal = triangle == Triangle::upper ? CblasNonUnit : CblasUnit;
  const auto transpose = transposed ? CblasTrans : CblasNoTrans;
  if (columns == 1) {
    cblas_dtrsv(CblasColMajor, part, transpose, diagonal, size, lu, stride, x, 1);
  } else {
    cblas_dtrsm(CblasColMajor, CblasLeft, part, transpose, diagonal, size, columns, 1, lu, stride, x, xStride);
  }
}

void solveUpperFromRight(int rows, int size, const double* lu, int stride, double* x, int xStride) {
  cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, rows, size, 1, lu, stride, x, xStride);
}

void subtractProduct(bool transposed, int rows, int columns, const double* a, int stride, int count, const double* x,
                     int xStride, double* y, int yStride) {
  const auto transpose = transposed ? CblasTrans : CblasNoTrans;
  if (count == 1) {
    cblas_dgemv(CblasColMajor, transpose, rows, columns, -1, a, stride, x, 1, 1, y, 1);
  } else {
    cblas_dgemm(CblasColMajor, transpose, CblasNoTrans, transposed ? columns : rows, count, transposed ? rows : columns,
                -1, a, stride, x, xStride, 1, y, yStride);
  }
}

}  // namespace pliant::math
