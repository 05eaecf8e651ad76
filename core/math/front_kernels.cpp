#include "core/math/front_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/packet.hpp"

namespace pliant::math {

namespace {

constexpr int lanes = Packet::lanes;
using Register = Packet::Register;
using LooseRegister = double __attribute__((vector_size(lanes * sizeof(double)), aligned(8), may_alias));

Register loadRegister(const double* from) { return *reinterpret_cast<const LooseRegister*>(from); }
void storeRegister(double* to, const Register& value) { *reinterpret_cast<LooseRegister*>(to) = value; }

/// c (vectors * lanes rows, `columns` columns) -= a bᵀ, with `inner` columns of a and b.
template <int vectors, int columns>
void subtractTile(int inner, const double* a, const double* b, int stride, double* c, int cStride) {
  Register sum[vectors][columns];
  for (int j = 0; j < columns; ++j)
    for (int v = 0; v < vectors; ++v) sum[v][j] = loadRegister(c + j * cStride + v * lanes);
  for (int k = 0; k < inner; ++k) {
    Register column[vectors];
    for (int v = 0; v < vectors; ++v) column[v] = loadRegister(a + v * lanes);
    for (int j = 0; j < columns; ++j) {
      const Register factor = Register{} + b[j];
      for (int v = 0; v < vectors; ++v) sum[v][j] -= column[v] * factor;
    }
    a += stride;
    b += stride;
  }
  for (int j = 0; j < columns; ++j)
    for (int v = 0; v < vectors; ++v) storeRegister(c + j * cStride + v * lanes, sum[v][j]);
}

/// The same for all rows from `begin` (a multiple of lanes) to `end`, rounded up.
template <int columns>
void subtractColumns(int begin, int end, int inner, const double* a, const double* b, int stride, double* c,
                     int cStride) {
  int i = begin;
  for (; i + lanes < end; i += 2 * lanes) subtractTile<2, columns>(inner, a + i, b, stride, c + i, cStride);
  if (i < end) subtractTile<1, columns>(inner, a + i, b, stride, c + i, cStride);
}

int registerBegin(int row) { return row / lanes * lanes; }

/// Factorises the diagonal block of `columns` columns at `diagonal` and divides all rows of these columns by it.
template <int columns>
bool factorizeColumns(int begin, int end, double* column, int first, int stride, double* inversePivots) {
  double block[columns][columns];  // [column][row]
  for (int j = 0; j < columns; ++j) {
    for (int i = j; i < columns; ++i) {
      double value = column[j * stride + first + i];
      for (int k = 0; k < j; ++k) value -= block[k][i] * block[k][j];
      block[j][i] = value;
    }
    if (!(block[j][j] > 0) || !std::isfinite(block[j][j])) return false;
    const double root = std::sqrt(block[j][j]);
    block[j][j] = root;
    inversePivots[j] = 1 / root;
    for (int i = j + 1; i < columns; ++i) block[j][i] *= inversePivots[j];
  }
  for (int i = begin; i < end; i += lanes) {
    Register x[columns];
    for (int j = 0; j < columns; ++j) {
      x[j] = loadRegister(column + j * stride + i);
      for (int k = 0; k < j; ++k) x[j] -= x[k] * (Register{} + block[k][j]);
      x[j] *= Register{} + inversePivots[j];
      storeRegister(column + j * stride + i, x[j]);
    }
  }
  // Its registers reach into the diagonal block.
  for (int j = 0; j < columns; ++j)
    for (int i = j; i < columns; ++i) column[j * stride + first + i] = block[j][i];
  return true;
}

}  // namespace

int frontStride(int rows) { return (rows + lanes - 1) / lanes * lanes + lanes; }

bool factorizeFront(int pivots, int rows, double* panel, int stride, double* inversePivots) {
  const int size = pivots + rows;
  for (int j = 0; j < pivots;) {
    const int columns = pivots - j >= 6 ? 6 : 3;
    double* column = panel + static_cast<std::ptrdiff_t>(j) * stride;
    const auto update = columns == 6 ? subtractColumns<6> : subtractColumns<3>;
    if (j > 0) update(registerBegin(j), size, j, panel, panel + j, stride, column, stride);
    const auto factorize = columns == 6 ? factorizeColumns<6> : factorizeColumns<3>;
    if (!factorize(registerBegin(j + columns), size, column, j, stride, inversePivots + j)) return false;
    j += columns;
  }
  return true;
}

void subtractOuterProduct(int pivots, int rows, const double* lower, int stride, double* update, int updateStride) {
  for (int j = 0; j < rows;) {
    const int columns = rows - j >= 6 ? 6 : 3;
    const auto subtract = columns == 6 ? subtractColumns<6> : subtractColumns<3>;
    subtract(registerBegin(j), rows, pivots, lower, lower + j, stride,
             update + static_cast<std::ptrdiff_t>(j) * updateStride, updateStride);
    j += columns;
  }
}

void multiplyFront(int pivots, int rows, const double* lower, int stride, const double* x, double* y) {
  std::fill_n(y, (rows + lanes - 1) / lanes * lanes, 0.0);
  for (int j = 0; j < pivots; j += 3) {  // a multiple of 3
    const double* column = lower + static_cast<std::ptrdiff_t>(j) * stride;
    const Register first = Register{} + x[j], second = Register{} + x[j + 1], third = Register{} + x[j + 2];
    for (int i = 0; i < rows; i += lanes)
      storeRegister(y + i, loadRegister(y + i) + loadRegister(column + i) * first +
                               loadRegister(column + stride + i) * second +
                               loadRegister(column + 2 * stride + i) * third);
  }
}

void subtractTransposedFront(int pivots, int rows, const double* lower, int stride, const double* y, double* x) {
  const int whole = rows / lanes * lanes;
  for (int j = 0; j < pivots; j += 3) {  // a multiple of 3
    const double* column = lower + static_cast<std::ptrdiff_t>(j) * stride;
    Register sums[3] = {};
    for (int i = 0; i < whole; i += lanes) {
      const Register value = loadRegister(y + i);
      for (int k = 0; k < 3; ++k) sums[k] += loadRegister(column + k * stride + i) * value;
    }
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int lane = 0; lane < lanes; ++lane) sum += sums[k][lane];
      for (int i = whole; i < rows; ++i) sum += column[k * stride + i] * y[i];
      x[j + k] -= sum;
    }
  }
}

void solveFront(int pivots, const double* panel, int stride, const double* inversePivots, double* x) {
  for (int j = 0; j < pivots; ++j) {
    const double* column = panel + static_cast<std::ptrdiff_t>(j) * stride;
    const double value = x[j] *= inversePivots[j];
    for (int i = j + 1; i < pivots; ++i) x[i] -= column[i] * value;
  }
}

void solveFrontTransposed(int pivots, const double* panel, int stride, const double* inversePivots, double* x) {
  for (int j = pivots - 1; j >= 0; --j) {
    const double* column = panel + static_cast<std::ptrdiff_t>(j) * stride;
    double sum = x[j];
    for (int i = j + 1; i < pivots; ++i) sum -= column[i] * x[i];
    x[j] = sum * inversePivots[j];
  }
}

}  // namespace pliant::math
