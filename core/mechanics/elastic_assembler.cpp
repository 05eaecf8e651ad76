#include "core/mechanics/elastic_assembler.hpp"

#include <algorithm>

#include "core/math/parallel.hpp"

namespace pliant::mechanics {

namespace {

constexpr int width = math::Packet::width;
/// Packets of elements that take no longer than to wake a thread.
constexpr Eigen::Index fewPackets = 400;

/// Calls visit(row, column) for the packed lower triangle of every element: free indices with row >= column, or -1, -1
/// where one of the coordinates is not free.
template <class Visit>
void forEachEntry(const Model& model, const Energy& energy, const Visit& visit) {
  for (int e = 0; e < energy.elementCount(); ++e) {
    const std::span<const int> coordinates = energy.elementCoordinates(e);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const int a = model.dofs.freeIndex[coordinates[i]];
        const int b = model.dofs.freeIndex[coordinates[j]];
        if (a < 0 || b < 0)
          visit(-1, -1);
        else
          visit(std::max(a, b), std::min(a, b));
      }
  }
}

}  // namespace

ElasticAssembler::ElasticAssembler(std::shared_ptr<const Model> model) : model_(std::move(model)) {
  const auto keyOf = [](int row, int column) { return (static_cast<long>(column) << 32) | static_cast<long>(row); };
  std::vector<long> keys;
  for (const auto& energy : model_->energies)
    forEachEntry(*model_, *energy, [&](int row, int column) {
      if (row >= 0) keys.push_back(keyOf(row, column));
    });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const long key : keys) {
    rows_.push_back(static_cast<int>(key & 0xffffffffL));
    columns_.push_back(static_cast<int>(key >> 32));
  }
  for (const auto& energy : model_->energies) {
    std::vector<int>& entries = entries_.emplace_back();
    forEachEntry(*model_, *energy, [&](int row, int column) {
      const auto found = std::lower_bound(keys.begin(), keys.end(), keyOf(row, column));
      entries.push_back(row < 0 ? -1 : static_cast<int>(found - keys.begin()));
    });
  }
}

int ElasticAssembler::paddedRows(int samples) { return (samples + width - 1) / width * width; }

void ElasticAssembler::evaluate(const Matrix& x, Matrix& gradient, Matrix* hessian,
                                const StressSource* stresses) const {
  const Eigen::Index rows = x.rows(), coordinates = x.cols(), entries = hessian ? entryCount() : 0;
  gradient.resize(rows, coordinates);
  if (hessian) hessian->resize(rows, entries);
  const auto evaluatePacket = [&](int packet) {
    // A packet is evaluated in a matrix of its own: entries that lie side by side use the caches better, and threads
    // never write to the same cache line.
    thread_local Eigen::Matrix<double, width, Eigen::Dynamic> work;
    work.resize(width, (stresses ? 4 : 2) * coordinates + entries);
    work.leftCols(coordinates) = x.middleRows<width>(packet * width);
    work.middleCols(coordinates, coordinates + entries).setZero();
    if (stresses) {
      work.middleCols(2 * coordinates + entries, coordinates) = stresses->from.middleRows<width>(packet * width);
      work.middleCols(3 * coordinates + entries, coordinates) = stresses->to.middleRows<width>(packet * width);
    }
    EvaluationBlock<math::Packet> block;
    block.x = work.data();
    block.gradient = work.data() + coordinates * width;
    block.hessian = hessian ? work.data() + 2 * coordinates * width : nullptr;
    block.stride = width;
    if (stresses) {
      block.stressFrom = work.data() + (2 * coordinates + entries) * width;
      block.stressTo = work.data() + (3 * coordinates + entries) * width;
    }
    for (std::size_t i = 0; i < model_->energies.size(); ++i) {
      block.entries = entries_[i].data();
      model_->energies[i]->accumulate(block);
    }
    gradient.middleRows<width>(packet * width) = work.middleCols(coordinates, coordinates);
    if (hessian) hessian->middleRows<width>(packet * width) = work.middleCols(2 * coordinates, entries);
  };
  Eigen::Index elements = 0;
  for (const auto& energy : model_->energies) elements += energy->elementCount();
  const int packets = static_cast<int>(rows) / width;
  if (packets * elements > fewPackets)
    math::parallelFor(packets, evaluatePacket);
  else
    for (int packet = 0; packet < packets; ++packet) evaluatePacket(packet);
}

double ElasticAssembler::value(const Vector& x) const {
  double sum = 0;
  EvaluationBlock<double> block;
  block.x = x.data();
  block.value = &sum;
  for (const auto& energy : model_->energies) energy->accumulate(block);
  return sum;
}

Vector ElasticAssembler::gradient(const Vector& x) const {
  Vector sum = Vector::Zero(x.size());
  EvaluationBlock<double> block;
  block.x = x.data();
  block.gradient = sum.data();
  for (const auto& energy : model_->energies) energy->accumulate(block);
  return sum;
}

void ElasticAssembler::hessianEntries(const Vector& x, Vector& entries, HessianKind kind) const {
  entries.setZero(entryCount());
  EvaluationBlock<double> block;
  block.x = x.data();
  block.hessian = entries.data();
  block.convex = kind == HessianKind::convex;
  for (std::size_t i = 0; i < model_->energies.size(); ++i) {
    block.entries = entries_[i].data();
    model_->energies[i]->accumulate(block);
  }
}

SparseMatrix ElasticAssembler::hessian(const Vector& x) const {
  Vector entries;
  hessianEntries(x, entries);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int s = 0; s < entryCount(); ++s) {
    triplets.emplace_back(rows_[s], columns_[s], entries[s]);
    if (rows_[s] != columns_[s]) triplets.emplace_back(columns_[s], rows_[s], entries[s]);
  }
  SparseMatrix matrix(model_->dofs.freeCount(), model_->dofs.freeCount());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace pliant::mechanics
