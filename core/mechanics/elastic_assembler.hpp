#pragma once

#include <vector>

#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// The exact Hessian of an energy that is not convex is indefinite somewhere. In the convex one membranes leave out the
/// compressive part of their stresses, and hinges the curvature of their angle; what is left of both is positive
/// semidefinite. Other energies have the exact one either way.
enum class HessianKind { exact, convex };

/// Evaluates the energies of a model for many configurations at once: eight at a time in a packet, packets spread over
/// the threads, each element visited once. Sums run in a fixed order, so results do not depend on the threads.
class ElasticAssembler {
 public:
  /// Stresses for Hessians other than those at x: linearised at `from` and extrapolated to `to` (both like x), by every
  /// energy whose elements can (membranes). A Newton iterate or a prediction that is off by δ bears spurious stresses
  /// of second order in δ, which in a thin shell outweigh its bending stiffness however small δ is; the stresses
  /// expected by linearisation do not, and convergence is no longer confined to errors of a fraction of the thickness
  /// (mixed integration point iteration: Magisano, Leonetti & Garcea 2017).
  struct StressSource {
    Matrix from;
    Matrix to;
  };

  explicit ElasticAssembler(std::shared_ptr<const Model> model);

  /// Lower triangle of the free-free Hessian: rows_[s] >= columns_[s] are free indices of entry s, sorted by column.
  int entryCount() const { return static_cast<int>(rows_.size()); }
  const std::vector<int>& rows() const { return rows_; }
  const std::vector<int>& columns() const { return columns_; }

  /// Rows of the sample matrices below: `samples` rounded up to whole packets. Padding rows are ignored.
  static int paddedRows(int samples);

  /// `x`: paddedRows x coordinates, one configuration a row [m] (padding rows must hold valid positions: repeat a row).
  /// Fills `gradient` (like x) and, if not null, `hessian` (paddedRows x entryCount), with the stresses of `stresses`
  /// if it is not null.
  void evaluate(const Matrix& x, Matrix& gradient, Matrix* hessian, const StressSource* stresses = nullptr) const;

  /// The energy [J], its gradient on all coordinates, and its free-free Hessian (full, symmetric) at one configuration.
  double value(const Vector& x) const;
  Vector gradient(const Vector& x) const;
  SparseMatrix hessian(const Vector& x) const;
  /// The same Hessian as the values of its entries, in the order of rows() and columns().
  void hessianEntries(const Vector& x, Vector& entries, HessianKind kind = HessianKind::exact) const;

 private:
  std::shared_ptr<const Model> model_;
  std::vector<int> rows_;
  std::vector<int> columns_;
  std::vector<std::vector<int>> entries_;  ///< per energy: `EvaluationBlock::entries`
};

}  // namespace pliant::mechanics
