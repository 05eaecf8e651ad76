#pragma once

#include <vector>

#include "core/mechanics/model.hpp"

namespace pliant::mechanics {

/// Evaluates the energies of a model for many configurations at once: eight at a time in a packet, packets spread over
/// the threads, each element visited once. Sums run in a fixed order, so results do not depend on the threads.
class ElasticAssembler {
 public:
  explicit ElasticAssembler(std::shared_ptr<const Model> model);

  /// Lower triangle of the free-free Hessian: rows_[s] >= columns_[s] are free indices of entry s, sorted by column.
  int entryCount() const { return static_cast<int>(rows_.size()); }
  const std::vector<int>& rows() const { return rows_; }
  const std::vector<int>& columns() const { return columns_; }

  /// Rows of the sample matrices below: `samples` rounded up to whole packets. Padding rows are ignored.
  static int paddedRows(int samples);

  /// `x`: paddedRows x coordinates, one configuration a row [m] (padding rows must hold valid positions: repeat a row).
  /// Fills `gradient` (like x) and, if not null, `hessian` (paddedRows x entryCount).
  void evaluate(const Matrix& x, Matrix& gradient, Matrix* hessian) const;

  /// The energy [J], its gradient on all coordinates, and its free-free Hessian (full, symmetric) at one configuration.
  double value(const Vector& x) const;
  Vector gradient(const Vector& x) const;
  SparseMatrix hessian(const Vector& x) const;

 private:
  std::shared_ptr<const Model> model_;
  std::vector<int> rows_;
  std::vector<int> columns_;
  std::vector<std::vector<int>> entries_;  ///< per energy: `EvaluationBlock::entries`
};

}  // namespace pliant::mechanics
