#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/math/packet.hpp"

namespace pliant::mechanics {

/// What an energy reads and adds to, for as many time samples at once as `T` has lanes. Coordinate c of the first
/// sample stands at x[c * stride]; the other samples of a packet follow it.
template <class T>
struct EvaluationBlock {
  const double* x = nullptr;
  double* value = nullptr;       ///< laneCount<T> energies [J]; added to
  double* gradient = nullptr;    ///< like x [N]; added to; null: not wanted
  double* hessian = nullptr;     ///< entry s of the pattern at hessian[s * stride] [N/m]; added to; null: not wanted
  const int* entries = nullptr;  ///< element-wise packed lower triangles -> entry of the pattern, -1: not wanted
  long stride = 1;
  /// Like x, or both null: see ElasticAssembler::StressSource.
  const double* stressFrom = nullptr;
  const double* stressTo = nullptr;
  /// Whether elements that can (membranes, hinges) leave out of their Hessians what makes them indefinite.
  bool convex = false;
};

/// Packed lower triangle: entry (row, column) with row >= column.
constexpr int packedIndex(int row, int column) { return row * (row + 1) / 2 + column; }
constexpr int packedSize(int n) { return n * (n + 1) / 2; }

/// A sum of element energies E(x), each a function of the same small number of coordinates.
/// Constant once built; any thread may evaluate it.
class Energy {
 public:
  virtual ~Energy() = default;

  virtual std::string_view name() const = 0;
  virtual int elementCount() const = 0;
  /// Global coordinate indices (node * dimension + axis) of one element, in the order of its packed Hessian.
  virtual std::span<const int> elementCoordinates(int element) const = 0;

  virtual void accumulate(const EvaluationBlock<double>& block) const = 0;
  virtual void accumulate(const EvaluationBlock<math::Packet>& block) const = 0;

  /// Of energies that stand for constraints, such as rigid links: the largest relative violation of any element at the
  /// coordinates x. None of others.
  virtual std::optional<double> constraintViolation(const double* x) const {
    static_cast<void>(x);
    return std::nullopt;
  }
};

}  // namespace pliant::mechanics
