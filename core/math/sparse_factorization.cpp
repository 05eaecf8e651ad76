#include "core/math/sparse_factorization.hpp"

#include <cblas.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/math/parallel.hpp"
#include "core/math/umfpack_factorization.hpp"

namespace pliant::math {

namespace {

/// Below this ratio of pivots the condition number is estimated; above it the matrix counts as regular.
constexpr double suspiciousPivotRatio = 1e-9;

/// OpenBLAS sums in another order with each number of threads. Our parallelism lies above it (parallelFor), so it is
/// held to one, for the whole process, before the first factorisation.
void useOneBlasThread() {
  static const bool done = [] {
    openblas_set_num_threads(1);
    return true;
  }();
  (void)done;
}

bool samePattern(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// Estimates ‖B‖₁ of a square operator from a few products with B and Bᵀ (Hager 1984).
template <class Product, class TransposedProduct>
double estimateNorm(Eigen::Index size, const Product& product, const TransposedProduct& transposedProduct) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(size, 1.0 / static_cast<double>(size));
  double estimate = 0;
  for (int step = 0; step < 5; ++step) {
    const Eigen::VectorXd y = product(x);
    const double norm = y.lpNorm<1>();
    if (!std::isfinite(norm)) return std::numeric_limits<double>::infinity();
    if (norm <= estimate) break;
    estimate = norm;
    const Eigen::VectorXd slope = transposedProduct(y.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; }).eval());
    Eigen::Index steepest = 0;
    if (slope.cwiseAbs().maxCoeff(&steepest) <= slope.dot(x)) break;
    x = Eigen::VectorXd::Unit(size, steepest);
  }
  return estimate;
}

}  // namespace

struct SparseFactorization::Implementation {
  SparseMatrix matrix;
  UmfpackFactorization umfpack;
  bool analyzed = false;
  bool regular = false;

  Eigen::MatrixXd solveOnce(const Eigen::MatrixXd& b, bool transposed) const {
    Eigen::MatrixXd x(b.rows(), b.cols());
    parallelFor(static_cast<int>(b.cols()),
                [&](int column) { umfpack.solve(matrix, transposed, b.col(column).data(), x.col(column).data()); });
    return x;
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& b, bool transposed) const {
    assert(regular && b.rows() == matrix.rows());
    Eigen::MatrixXd x = solveOnce(b, transposed);
    const Eigen::MatrixXd residual = transposed ? (b - matrix.transpose() * x).eval() : (b - matrix * x).eval();
    x += solveOnce(residual, transposed);
    return x;
  }

  /// ‖S‖₁ ‖S⁻¹‖₁ with S = R A C, where R and C scale every row and column to a largest entry of about 1 (Ruiz 2001).
  double estimateCondition() const {
    const Eigen::Index n = matrix.rows();
    Eigen::ArrayXd rowScale = Eigen::ArrayXd::Ones(n);
    Eigen::ArrayXd columnScale = Eigen::ArrayXd::Ones(n);
    Eigen::ArrayXd columnSums(n);
    for (int sweep = 0; sweep < 8; ++sweep) {
      Eigen::ArrayXd rowMaxima = Eigen::ArrayXd::Zero(n);
      Eigen::ArrayXd columnMaxima = Eigen::ArrayXd::Zero(n);
      columnSums.setZero();
      for (Eigen::Index j = 0; j < n; ++j) {
        for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
          const double value = std::abs(it.value()) * rowScale[it.row()] * columnScale[j];
          rowMaxima[it.row()] = std::max(rowMaxima[it.row()], value);
          columnMaxima[j] = std::max(columnMaxima[j], value);
          columnSums[j] += value;
        }
      }
      if (rowMaxima.minCoeff() == 0 || columnMaxima.minCoeff() == 0) return std::numeric_limits<double>::infinity();
      if (sweep == 7) break;  // the sums belong to the last scales
      rowScale /= rowMaxima.sqrt();
      columnScale /= columnMaxima.sqrt();
    }
    const double inverseNorm = estimateNorm(
        n,
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return solveOnce((x.array() / rowScale).matrix(), false).array() / columnScale;
        },
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return solveOnce((x.array() / columnScale).matrix(), true).array() / rowScale;
        });
    return columnSums.maxCoeff() * inverseNorm;
  }
};

SparseFactorization::SparseFactorization() : implementation_(std::make_unique<Implementation>()) { useOneBlasThread(); }
SparseFactorization::~SparseFactorization() = default;
SparseFactorization::SparseFactorization(SparseFactorization&&) noexcept = default;
SparseFactorization& SparseFactorization::operator=(SparseFactorization&&) noexcept = default;

bool SparseFactorization::factorize(const SparseMatrix& matrix) {
  if (matrix.rows() != matrix.cols()) throw std::invalid_argument("only a square matrix has an LU factorisation");
  Implementation& self = *implementation_;
  self.regular = false;
  if (matrix.isCompressed() && self.analyzed && samePattern(matrix, self.matrix)) {
    std::copy_n(matrix.valuePtr(), matrix.nonZeros(), self.matrix.valuePtr());
  } else {
    self.matrix = matrix;
    self.matrix.makeCompressed();
    self.analyzed = false;
  }
  const Eigen::Map<const Eigen::ArrayXd> values(self.matrix.valuePtr(), self.matrix.nonZeros());
  if (values.size() == 0 || !values.isFinite().all()) return false;
  if (!self.analyzed) self.umfpack.analyze(self.matrix);
  self.analyzed = true;
  const double pivotRatio = self.umfpack.factorize(self.matrix);
  self.regular = pivotRatio > suspiciousPivotRatio ||
                 (pivotRatio > 0 && self.estimateCondition() < 1 / std::numeric_limits<double>::epsilon());
  return self.regular;
}

Eigen::MatrixXd SparseFactorization::solve(const Eigen::MatrixXd& b) const { return implementation_->solve(b, false); }

Eigen::MatrixXd SparseFactorization::solveTransposed(const Eigen::MatrixXd& b) const {
  return implementation_->solve(b, true);
}

double SparseFactorization::backwardError(const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) const {
  const SparseMatrix& matrix = implementation_->matrix;
  const double matrixNorm = (matrix.cwiseAbs() * Eigen::VectorXd::Ones(matrix.cols())).maxCoeff();
  const Eigen::MatrixXd residual = b - matrix * x;
  double largest = 0;
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    const double scale = matrixNorm * x.col(j).lpNorm<Eigen::Infinity>() + b.col(j).lpNorm<Eigen::Infinity>();
    if (scale > 0) largest = std::max(largest, residual.col(j).lpNorm<Eigen::Infinity>() / scale);
  }
  return largest;
}

int SparseFactorization::determinantSign() const {
  return implementation_->regular ? implementation_->umfpack.determinantSign() : 0;
}
double SparseFactorization::factorEntries() const { return implementation_->umfpack.factorEntries(); }
double SparseFactorization::flops() const { return implementation_->umfpack.flops(); }

}  // namespace pliant::math
