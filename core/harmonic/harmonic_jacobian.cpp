#include "core/harmonic/harmonic_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/math/parallel.hpp"

namespace pliant::harmonic {

namespace {

/// Columns of coordinates that one task assembles.
constexpr int columnsPerTask = 16;

Matrix coefficientTransform(const math::HarmonicBasis& basis, const std::vector<std::array<int, 2>>& combinations) {
  const int samples = basis.samples(), count = static_cast<int>(combinations.size());
  Matrix transform(2 * count + 1, samples);
  for (int i = 0; i < samples; ++i) {
    transform(0, i) = 1.0 / samples;
    for (int m = 1; m <= count; ++m) {
      const double phase = basis.samplePhase(combinations[static_cast<std::size_t>(m) - 1], i);
      transform(2 * m - 1, i) = std::sin(phase) / samples;
      transform(2 * m, i) = std::cos(phase) / samples;
    }
  }
  return transform;
}

struct Pair {
  int row;
  int column;
  int entry;
  double mass;
};

/// Union of the Hessian's and the mass matrix's lower triangles, sorted by column, then row.
std::vector<Pair> collectPairs(const mechanics::ElasticAssembler& assembler, const SparseMatrix& mass) {
  std::vector<Pair> pairs;
  for (int entry = 0; entry < assembler.entryCount(); ++entry)
    pairs.push_back({assembler.rows()[entry], assembler.columns()[entry], entry, 0});
  for (int column = 0; column < mass.outerSize(); ++column) {
    pairs.push_back({column, column, -1, 0});  // every coordinate has a diagonal block
    for (SparseMatrix::InnerIterator it(mass, column); it; ++it)
      if (it.row() >= column) pairs.push_back({static_cast<int>(it.row()), column, -1, it.value()});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.column, a.row, b.entry) < std::tie(b.column, b.row, a.entry);
  });
  std::vector<Pair> merged;
  for (const Pair& pair : pairs) {
    if (merged.empty() || merged.back().row != pair.row || merged.back().column != pair.column) {
      merged.push_back(pair);
    } else {
      merged.back().mass += pair.mass;
    }
  }
  return merged;
}

}  // namespace

HarmonicJacobian::HarmonicJacobian(const math::HarmonicBasis& basis, const mechanics::ElasticAssembler& assembler,
                                   const SparseMatrix& mass, const std::vector<int>& coordinateHarmonics)
    : harmonics_(basis.harmonics()) {
  const std::vector<std::array<int, 2>> combinations = basis.combinations(2 * basis.order());
  extent_ = static_cast<int>(combinations.size());
  transform_ = coefficientTransform(basis, combinations);
  for (int k = 0; k <= harmonics_; ++k) rates_.push_back(k > 0 ? basis.rate(k) : 0);
  if (basis.hasTwoFrequencies()) combineHarmonics(combinations);
  const int count = static_cast<int>(mass.cols());
  const std::vector<Pair> pairs = collectPairs(assembler, mass);
  const auto width = [&](int coordinate) { return 2 * coordinateHarmonics[coordinate] + 1; };

  std::vector<std::vector<int>> neighbors(count);
  for (const Pair& pair : pairs) {
    neighbors[pair.column].push_back(pair.row);
    if (pair.row != pair.column) neighbors[pair.row].push_back(pair.column);
  }
  std::vector<int> offsets(count + 1, 0);        // first unknown of each coordinate
  std::vector<long> starts(count + 1, 0);        // first entry
  std::vector<long> strides(count, 0);           // entries a column
  std::vector<std::vector<long>> places(count);  // of each neighbour's rows in a column
  for (int c = 0; c < count; ++c) {
    std::sort(neighbors[c].begin(), neighbors[c].end());
    for (const int r : neighbors[c]) {
      places[c].push_back(strides[c]);
      strides[c] += width(r);
    }
    offsets[c + 1] = offsets[c] + width(c);
    starts[c + 1] = starts[c] + strides[c] * width(c);
  }

  outerStarts_.resize(offsets[count] + 1);
  innerIndices_.resize(starts[count]);
  for (int c = 0; c < count; ++c) {
    for (int column = 0; column < width(c); ++column) {
      long at = starts[c] + column * strides[c];
      outerStarts_[offsets[c] + column] = static_cast<int>(at);
      for (const int r : neighbors[c])
        for (int row = 0; row < width(r); ++row) innerIndices_[at++] = offsets[r] + row;
    }
  }
  outerStarts_[offsets[count]] = static_cast<int>(starts[count]);

  const auto position = [&](int row, int column) {
    const auto& list = neighbors[column];
    return starts[column] + places[column][std::lower_bound(list.begin(), list.end(), row) - list.begin()];
  };
  columnBlocks_.assign(count + 1, 0);
  columnEntries_.assign(count + 1, 0);
  for (const Pair& pair : pairs) {
    blocks_.push_back({pair.entry, pair.mass, position(pair.row, pair.column), strides[pair.column],
                       position(pair.column, pair.row), strides[pair.row], width(pair.row), width(pair.column),
                       pair.row == pair.column});
    ++columnBlocks_[pair.column + 1];
    if (pair.entry >= 0) ++columnEntries_[pair.column + 1];
  }
  for (int c = 0; c < count; ++c) {
    columnBlocks_[c + 1] += columnBlocks_[c];
    columnEntries_[c + 1] += columnEntries_[c];
  }
}

void HarmonicJacobian::combineHarmonics(const std::vector<std::array<int, 2>>& combinations) {
  std::map<std::array<int, 2>, int> places{{{0, 0}, 0}};
  for (int m = 1; m <= extent_; ++m) {
    const auto [first, second] = combinations[static_cast<std::size_t>(m) - 1];
    places[{first, second}] = m;
    places[{-first, -second}] = -m;
  }
  for (int k = 0; k < harmonics_; ++k)
    for (int j = 0; j < harmonics_; ++j) {
      const auto &a = combinations[static_cast<std::size_t>(j)], &b = combinations[static_cast<std::size_t>(k)];
      mixed_.push_back({places.at({a[0] - b[0], a[1] - b[1]}), places.at({a[0] + b[0], a[1] + b[1]})});
    }
}

void HarmonicJacobian::assemble(const Matrix& stiffness, double omega, double massDamping, double stiffnessDamping,
                                Matrix& coefficients, SparseMatrix& jacobian) const {
  if (jacobian.rows() != size() || jacobian.cols() != size() || jacobian.nonZeros() != entryCount() ||
      !std::equal(outerStarts_.begin(), outerStarts_.end(), jacobian.outerIndexPtr())) {
    jacobian.resize(size(), size());
    jacobian.resizeNonZeros(entryCount());
    std::copy(outerStarts_.begin(), outerStarts_.end(), jacobian.outerIndexPtr());
    std::copy(innerIndices_.begin(), innerIndices_.end(), jacobian.innerIndexPtr());
  }
  coefficients.resize(transform_.rows(), stiffness.cols());
  const int columns = static_cast<int>(columnBlocks_.size()) - 1;
  double* values = jacobian.valuePtr();
  math::parallelFor((columns + columnsPerTask - 1) / columnsPerTask, [&](int task) {
    const int begin = task * columnsPerTask;
    const int end = std::min(begin + columnsPerTask, columns);
    const int firstEntry = columnEntries_[begin];
    const int entries = columnEntries_[end] - firstEntry;
    coefficients.middleCols(firstEntry, entries).noalias() =
        transform_ * stiffness.block(0, firstEntry, transform_.cols(), entries);
    std::vector<double> scratch(4 * (2 * extent_ + 1) + 2 * harmonics_ + 2);
    double* weight = scratch.data() + 4 * (2 * extent_ + 1);
    for (int i = 2; i < 2 * harmonics_ + 2; ++i) weight[i] = stiffnessDamping * omega * rates_[i / 2];
    for (int b = columnBlocks_[begin]; b < columnBlocks_[end]; ++b)
      writeBlocks(blocks_[b], coefficients, omega, massDamping, scratch.data(), values);
  });
}

void HarmonicJacobian::writeBlocks(const Block& block, const Matrix& coefficients, double omega, double massDamping,
                                   double* scratch, double* values) const {
  // The rows of a block are the pairs (sin jτ, cos jτ), j = 1 .. H, below the constant. With U[m] = (P[m], -Q[m]) and
  // V[m] = (Q[m], P[m]) side by side, the pairs of the column sin kτ are U[j-k] - U[j+k] and d times them V[j-k] -
  // V[j+k]; those of cos kτ are V[j-k] + V[j+k] and -(U[j-k] + U[j+k]). P is even and Q is odd in m. Of two
  // frequencies, j-k and j+k are looked up.
  const int extent = extent_;
  double* u = scratch + 2 * extent;                       // u[2m], u[2m+1] = U[m] for |m| <= 2H
  double* v = u + 2 * (2 * extent + 1);                   // likewise V
  const double* weight = scratch + 4 * (2 * extent + 1);  // weight[2j], weight[2j+1] = D_β ω j

  if (block.entry >= 0) {
    const double* k = coefficients.data() + coefficients.rows() * block.entry;
    u[0] = v[1] = k[0];
    u[1] = v[0] = 0;
    for (int m = 1; m <= extent; ++m) {
      const double q = k[2 * m - 1];
      const double p = k[2 * m];
      u[2 * m] = u[-2 * m] = p;
      u[2 * m + 1] = -q;
      u[-2 * m + 1] = q;
      v[2 * m] = q;
      v[-2 * m] = -q;
      v[2 * m + 1] = v[-2 * m + 1] = p;
    }
  } else {
    std::fill_n(scratch, 4 * (2 * extent + 1), 0.0);
  }

  const auto write = [&](double* target, long stride, int rows, int columns) {
    target[0] = u[0];
    for (int i = 2; i <= rows; ++i) target[i - 1] = 2 * (v[i] - weight[i] * u[i]);
    for (int k = 1; 2 * k < columns; ++k) {
      double* sine = target + (2 * k - 1) * stride;
      double* cosine = target + 2 * k * stride;
      sine[0] = v[2 * k];
      cosine[0] = v[2 * k + 1];
      if (mixed_.empty()) {
        const double* um = u - 2 * k;
        const double* up = u + 2 * k;
        const double* vm = v - 2 * k;
        const double* vp = v + 2 * k;
        for (int i = 2; i <= rows; ++i) {
          sine[i - 1] = (um[i] - up[i]) + weight[i] * (vm[i] - vp[i]);
          cosine[i - 1] = (vm[i] + vp[i]) - weight[i] * (um[i] + up[i]);
        }
      } else {
        const Mixed* mixed = mixed_.data() + static_cast<std::ptrdiff_t>(k - 1) * harmonics_;
        for (int i = 2; i <= rows; ++i) {
          const int minus = 2 * mixed[i / 2 - 1].difference + i % 2;
          const int plus = 2 * mixed[i / 2 - 1].sum + i % 2;
          sine[i - 1] = (u[minus] - u[plus]) + weight[i] * (v[minus] - v[plus]);
          cosine[i - 1] = (v[minus] + v[plus]) - weight[i] * (u[minus] + u[plus]);
        }
      }
      if (2 * k >= rows) continue;
      const double inertia = -(rates_[k] * omega) * (rates_[k] * omega) * block.mass;
      const double friction = rates_[k] * omega * massDamping * block.mass;
      sine[2 * k - 1] += inertia;
      sine[2 * k] += friction;
      cosine[2 * k - 1] -= friction;
      cosine[2 * k] += inertia;
    }
  };
  write(values + block.lower, block.lowerStride, block.rowWidth, block.columnWidth);
  if (block.diagonal) return;
  if (block.rowWidth != block.columnWidth) {
    write(values + block.upper, block.upperStride, block.columnWidth, block.rowWidth);
    return;
  }
  for (int column = 0; column < block.columnWidth; ++column)
    std::copy_n(values + block.lower + column * block.lowerStride, block.rowWidth,
                values + block.upper + column * block.upperStride);
}

}  // namespace pliant::harmonic
