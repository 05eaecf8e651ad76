#pragma once

#include "core/mechanics/element_energy.hpp"

namespace pliant::mechanics {

/// A vector r = c + Σ (αᵢ xᵢ + βᵢ J xᵢ) that is linear in the positions xᵢ of n nodes, with J the quarter turn
/// counter-clockwise (in 2 dimensions; elsewhere all βᵢ are 0): the difference of two points that move with rigid
/// links, for instance.
template <int dimension, int n>
struct NodeCombination {
  static constexpr int coordinates = n * dimension;

  std::array<double, n> weights{};        ///< αᵢ
  std::array<double, n> turnedWeights{};  ///< βᵢ
  std::array<double, dimension> constant{};

  template <class T>
  std::array<T, dimension> value(const std::array<T, coordinates>& x) const {
    std::array<T, dimension> r;
    for (int a = 0; a < dimension; ++a) {
      r[a] = constant[a];
      for (int i = 0; i < n; ++i) r[a] += weights[i] * x[i * dimension + a];
    }
    if constexpr (dimension == 2)
      for (int i = 0; i < n; ++i) {
        r[0] -= turnedWeights[i] * x[2 * i + 1];
        r[1] += turnedWeights[i] * x[2 * i];
      }
    return r;
  }

  /// The derivative by the nodes of a function whose derivative by r is `g`.
  template <class T>
  void pullGradient(const std::array<T, dimension>& g, std::array<T, coordinates>& gradient) const {
    for (int i = 0; i < n; ++i)
      for (int a = 0; a < dimension; ++a) {
        gradient[i * dimension + a] = weights[i] * g[a];
        if constexpr (dimension == 2) gradient[2 * i + a] += turn(i, a) * g[1 - a];
      }
  }

  /// The same for second derivatives, both packed.
  template <class T>
  void pullHessian(const std::array<T, packedSize(dimension)>& h,
                   std::array<T, packedSize(coordinates)>& hessian) const {
    const auto entry = [&](int a, int b) -> const T& { return h[a >= b ? packedIndex(a, b) : packedIndex(b, a)]; };
    for (int j = 0; j < n; ++j)
      for (int b = 0; b < dimension; ++b) {
        std::array<T, dimension> column;  // of h times node j's matrix
        for (int a = 0; a < dimension; ++a) {
          column[a] = weights[j] * entry(a, b);
          if constexpr (dimension == 2) column[a] += turn(j, b) * entry(a, 1 - b);
        }
        for (int i = j; i < n; ++i)
          for (int a = i == j ? b : 0; a < dimension; ++a) {
            T value = weights[i] * column[a];
            if constexpr (dimension == 2) value += turn(i, a) * column[1 - a];
            hessian[packedIndex(i * dimension + a, j * dimension + b)] = value;
          }
      }
  }

 private:
  /// The entry of βᵢ J in row 1 - a and column a.
  double turn(int i, int a) const { return a == 0 ? turnedWeights[i] : -turnedWeights[i]; }
};

}  // namespace pliant::mechanics
