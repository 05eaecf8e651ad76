#include "core/math/umfpack_factorization.hpp"

#include <suitesparse/umfpack.h>

#include <array>
#include <new>
#include <stdexcept>

namespace pliant::math {

namespace {

std::array<double, UMFPACK_CONTROL> makeControl() {
  std::array<double, UMFPACK_CONTROL> control;
  umfpack_di_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_IRSTEP] = 0;
  return control;
}

void check(int status) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status < 0) throw std::logic_error("UMFPACK was given a matrix that it cannot read");
}

}  // namespace

UmfpackFactorization::UmfpackFactorization(const Eigen::SparseMatrix<double>& matrix) {
  const auto control = makeControl();
  void* symbolic = nullptr;
  check(umfpack_di_symbolic(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), matrix.outerIndexPtr(),
                            matrix.innerIndexPtr(), matrix.valuePtr(), &symbolic, control.data(), nullptr));
  symbolic_ = {symbolic, Free{umfpack_di_free_symbolic}};
}

double UmfpackFactorization::factorize(const Eigen::SparseMatrix<double>& matrix) {
  numeric_.reset();
  const auto control = makeControl();
  std::array<double, UMFPACK_INFO> info;
  void* numeric = nullptr;
  const int status = umfpack_di_numeric(matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr(),
                                        symbolic_.get(), &numeric, control.data(), info.data());
  check(status);
  numeric_ = {numeric, Free{umfpack_di_free_numeric}};
  factorEntries_ = info[UMFPACK_LNZ] + info[UMFPACK_UNZ] - static_cast<double>(matrix.rows());
  flops_ = info[UMFPACK_FLOPS];
  return status == UMFPACK_WARNING_singular_matrix ? 0.0 : info[UMFPACK_RCOND];
}

void UmfpackFactorization::solve(const Eigen::SparseMatrix<double>& matrix, bool transposed, const double* b,
                                 double* x) const {
  const auto control = makeControl();
  const int status =
      umfpack_di_solve(transposed ? UMFPACK_At : UMFPACK_A, matrix.outerIndexPtr(), matrix.innerIndexPtr(),
                       matrix.valuePtr(), x, b, numeric_.get(), control.data(), nullptr);
  check(status);
}

int UmfpackFactorization::determinantSign() const {
  double mantissa = 0;
  double exponent = 0;
  check(umfpack_di_get_determinant(&mantissa, &exponent, numeric_.get(), nullptr));
  return mantissa > 0 ? 1 : mantissa < 0 ? -1 : 0;
}

}  // namespace pliant::math
