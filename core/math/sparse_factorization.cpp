#include "core/math/sparse_factorization.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/math/block_pattern.hpp"
#include "core/math/dense_kernels.hpp"
#include "core/math/parallel.hpp"
#include "core/math/residual.hpp"
#include "core/math/supernodal_factorization.hpp"
#include "core/math/umfpack_factorization.hpp"

namespace pliant::math {

namespace {

/// Above this ratio of the smallest pivot to the largest, and below this growth of the errors, factors are trusted.
constexpr double safePivotRatio = 1e-9;
constexpr double safeMultiplier = 1e5;

/// Copies `from` to `to` if they have the same pattern.
bool copyValues(const SparseMatrix& from, SparseMatrix& to) {
  if (!from.isCompressed() || from.rows() != to.rows() || from.nonZeros() != to.nonZeros() ||
      !std::equal(from.outerIndexPtr(), from.outerIndexPtr() + from.cols() + 1, to.outerIndexPtr())) {
    return false;
  }
  constexpr Eigen::Index chunk = 1 << 17;
  const Eigen::Index entries = from.nonZeros();
  std::atomic<bool> same{true};
  parallelFor(static_cast<int>((entries + chunk - 1) / chunk), [&](int i) {
    const Eigen::Index begin = i * chunk;
    const Eigen::Index count = std::min(chunk, entries - begin);
    const int* rows = from.innerIndexPtr() + begin;
    if (!std::equal(rows, rows + count, to.innerIndexPtr() + begin)) same = false;
    std::copy_n(from.valuePtr() + begin, count, to.valuePtr() + begin);
  });
  return same;
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
  std::optional<BlockPattern> pattern;  ///< of `matrix`, once analysed
  std::optional<SupernodalFactorization> blocks;
  std::optional<UmfpackFactorization> umfpack;
  bool usesBlocks = false;
  bool trusted = false;  ///< the blocks' factors, without refinement
  bool regular = false;

  void solveOnce(bool transposed, const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const {
    if (usesBlocks) {
      blocks->solve(transposed, b, x);
      return;
    }
    x.resize(b.rows(), b.cols());
    parallelFor(static_cast<int>(b.cols()),
                [&](int column) { umfpack->solve(matrix, transposed, b.col(column).data(), x.col(column).data()); });
  }

  Eigen::MatrixXd solve(bool transposed, const Eigen::MatrixXd& b) const {
    constexpr int mostSteps = 5;
    Eigen::MatrixXd x;
    Eigen::MatrixXd correction;
    solveOnce(transposed, b, x);
    for (int step = 0; step < mostSteps; ++step) {
      solveOnce(transposed, residual(matrix, *pattern, transposed, x, b), correction);
      x += correction;
      // Each step gains about as many digits as this one did.
      if (!(correction.lpNorm<Eigen::Infinity>() > 1e-8 * x.lpNorm<Eigen::Infinity>())) break;
    }
    return x;
  }

  Eigen::MatrixXd solveRoughly(const Eigen::MatrixXd& b) const {
    if (!trusted) return solve(false, b);
    Eigen::MatrixXd x;
    solveOnce(false, b, x);
    return x;
  }

  double backwardError(const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) const {
    const double matrixNorm = (matrix.cwiseAbs() * Eigen::VectorXd::Ones(matrix.cols())).maxCoeff();
    const Eigen::MatrixXd difference = residual(matrix, *pattern, false, x, b);
    double largest = 0;
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      const double error = difference.col(j).lpNorm<Eigen::Infinity>();
      const double scale = matrixNorm * x.col(j).lpNorm<Eigen::Infinity>() + b.col(j).lpNorm<Eigen::Infinity>();
      if (!(error <= largest * scale)) largest = error / scale;
    }
    return largest;
  }

  /// The blocks' factors, or else UMFPACK's, and whether the matrix is regular.
  bool factorize() {
    double pivotRatio = 0;
    trusted = false;
    usesBlocks = blocks.has_value();
    if (usesBlocks) {
      pivotRatio = blocks->factorize(matrix.valuePtr());
      trusted = pivotRatio > safePivotRatio && blocks->largestMultiplier() < safeMultiplier;
      usesBlocks = pivotRatio > 0 && (trusted || solvesAccurately());
    }
    if (!usesBlocks) {
      const Eigen::Map<const Eigen::ArrayXd> values(matrix.valuePtr(), matrix.nonZeros());
      if (values.size() == 0 || !values.isFinite().all()) return false;
      if (!umfpack) umfpack.emplace(matrix);
      pivotRatio = umfpack->factorize(matrix);
    }
    return pivotRatio > safePivotRatio ||
           (pivotRatio > 0 && estimateCondition() < 1 / std::numeric_limits<double>::epsilon());
  }

  /// Whether the factors solve one arbitrary system up to rounding.
  bool solvesAccurately() const {
    Eigen::VectorXd b(matrix.rows());
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = std::sin(static_cast<double>(i) + 1);
    return backwardError(solve(false, b), b) < 1e-14;
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
          Eigen::MatrixXd y;
          solveOnce(false, (x.array() / rowScale).matrix(), y);
          return y.col(0).array() / columnScale;
        },
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          Eigen::MatrixXd y;
          solveOnce(true, (x.array() / columnScale).matrix(), y);
          return y.col(0).array() / rowScale;
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
  if (!self.pattern || !copyValues(matrix, self.matrix)) {
    self.matrix = matrix;
    self.matrix.makeCompressed();
    self.pattern.emplace(self.matrix);
    self.blocks.reset();
    self.umfpack.reset();
    if (SupernodalFactorization::suits(*self.pattern)) self.blocks.emplace(self.matrix, *self.pattern);
  }
  self.regular = self.factorize();
  return self.regular;
}

Eigen::MatrixXd SparseFactorization::solve(const Eigen::MatrixXd& b) const {
  assert(implementation_->regular && b.rows() == implementation_->matrix.rows());
  return implementation_->solve(false, b);
}

Eigen::MatrixXd SparseFactorization::solveTransposed(const Eigen::MatrixXd& b) const {
  assert(implementation_->regular && b.rows() == implementation_->matrix.rows());
  return implementation_->solve(true, b);
}

Eigen::MatrixXd SparseFactorization::solveRoughly(const Eigen::MatrixXd& b) const {
  assert(implementation_->regular && b.rows() == implementation_->matrix.rows());
  return implementation_->solveRoughly(b);
}

double SparseFactorization::backwardError(const Eigen::MatrixXd& x, const Eigen::MatrixXd& b) const {
  return implementation_->backwardError(x, b);
}

int SparseFactorization::determinantSign() const {
  const Implementation& self = *implementation_;
  if (!self.regular) return 0;
  return self.usesBlocks ? self.blocks->determinantSign() : self.umfpack->determinantSign();
}

double SparseFactorization::factorEntries() const {
  const Implementation& self = *implementation_;
  return self.usesBlocks ? self.blocks->factorEntries() : self.umfpack ? self.umfpack->factorEntries() : 0;
}

double SparseFactorization::flops() const {
  const Implementation& self = *implementation_;
  return self.usesBlocks ? self.blocks->flops() : self.umfpack ? self.umfpack->flops() : 0;
}

}  // namespace pliant::math
