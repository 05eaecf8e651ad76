#pragma once

namespace pliant::math {

// Dense matrices are column-major: a pointer to the first entry and the distance (`stride`) of the columns.

/// OpenBLAS sums in another order with each number of its threads. Our parallelism lies above it (parallelFor), so it
/// is held to one thread, for the whole process; call this before the first use of it.
void useOneBlasThread();

/// c = a b, with a: rows x inner, b: inner x columns.
void multiply(int rows, int columns, int inner, const double* a, int aStride, const double* b, int bStride, double* c,
              int cStride);

/// P A = L U in place with partial pivoting. `swaps[i]` is the row that row i was exchanged with in step i. Spread over
/// the threads if large; the result does not depend on how many there are. A zero pivot is left on the diagonal.
void factorizeDense(int size, double* a, int stride, int* swaps);

/// Exchanges rows i and swaps[i], i = 0 .. size-1, in `columns` columns.
void exchangeRows(int size, const int* swaps, int columns, double* x, int stride);
/// The inverse of exchangeRows.
void exchangeRowsBack(int size, const int* swaps, int columns, double* x, int stride);

enum class Triangle { unitLower, upper };
/// x = T⁻¹ x or T⁻ᵀ x, with T a triangle of an LU factorisation, x: size x columns.
void solveTriangle(Triangle triangle, bool transposed, int size, const double* lu, int stride, int columns, double* x,
                   int xStride);
/// x = x U⁻¹, x: rows x size.
void solveUpperFromRight(int rows, int size, const double* lu, int stride, double* x, int xStride);

/// y -= A x or Aᵀ x; A: rows x columns, x and y with `count` columns.
void subtractProduct(bool transposed, int rows, int columns, const double* a, int stride, int count, const double* x,
                     int xStride, double* y, int yStride);

}  // namespace pliant::math
