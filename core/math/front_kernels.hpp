#pragma once

#include <Eigen/Core>

namespace pliant::math {

// Dense kernels for fronts of a few to a few hundred columns, column-major. Rows are worked on in whole registers that
// begin at multiples of a register's length, so columns need a stride of at least that much more than their rows, and
// what lies above the diagonal or beyond the last row may be overwritten with anything.

/// A stride for columns of `rows` rows.
int frontStride(int rows);

/// Of a panel of `pivots` columns and `rows` more rows: its Cholesky factor in place, and the inverse diagonal. Columns
/// are a multiple of 3. False if a pivot is not above 0 or not finite.
bool factorizeFront(int pivots, int rows, double* panel, int stride, double* inversePivots);

/// update -= L Lᵀ (lower triangle), with L the `rows` rows from `lower` on, `pivots` columns; rows are a multiple of 3.
/// Reads `lower` up to the next whole register.
void subtractOuterProduct(int pivots, int rows, const double* lower, int stride, double* update, int updateStride);

/// y = L21 x and x -= L21ᵀ y, of a panel's rows below the pivots.
void multiplyFront(int pivots, int rows, const double* lower, int stride, const double* x, double* y);
void subtractTransposedFront(int pivots, int rows, const double* lower, int stride, const double* y, double* x);

/// x = L11⁻¹ x and x = L11⁻ᵀ x.
void solveFront(int pivots, const double* panel, int stride, const double* inversePivots, double* x);
void solveFrontTransposed(int pivots, const double* panel, int stride, const double* inversePivots, double* x);

}  // namespace pliant::math
