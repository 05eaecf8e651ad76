#pragma once

#include <cmath>

#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/node_combination.hpp"
#include "core/mechanics/spring_law.hpp"

namespace pliant::mechanics {

/// Keeps two joints at their distance l: E = ½ K l ε² with the Green strain ε = (|d|² - l²) / (2 l²), d = x₁ - x₀. It
/// is quadratic in |d|², so its Hessian can take its force from an extrapolation, without which Newton's method hardly
/// moves a linkage of stiff links.
template <int dimension>
struct RigidLinkElement {
  static constexpr int coordinates = 2 * dimension;
  static constexpr std::string_view name = "rigid_link";

  double stiffness;   ///< K [N], force per relative change of length
  double restLength;  ///< l [m]

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian, const std::array<T, coordinates>* stressFrom = nullptr,
             const std::array<T, coordinates>* stressTo = nullptr) const {
    std::array<T, dimension> d;
    T squared = 0.0;
    for (int i = 0; i < dimension; ++i) {
      d[i] = x[dimension + i] - x[i];
      squared += d[i] * d[i];
    }
    const T strain = strainOf(squared);
    const T ratio = (stiffness / restLength) * strain;  // force / length
    if (gradient)
      for (int i = 0; i < dimension; ++i) {
        (*gradient)[dimension + i] = ratio * d[i];
        (*gradient)[i] = -(*gradient)[dimension + i];
      }
    if (hessian) {
      T stress = ratio;
      if (stressFrom) {
        T expected = 0.0;
        for (int i = 0; i < dimension; ++i) {
          const T f = (*stressFrom)[dimension + i] - (*stressFrom)[i];
          expected += f * (2.0 * ((*stressTo)[dimension + i] - (*stressTo)[i]) - f);
        }
        stress = (stiffness / restLength) * strainOf(expected);
      }
      const double material = stiffness / (restLength * restLength * restLength);
      for (int i = 0; i < dimension; ++i)
        for (int j = 0; j < dimension; ++j) {
          T entry = material * d[i] * d[j];
          if (i == j) entry += stress;
          if (j <= i) (*hessian)[packedIndex(i, j)] = (*hessian)[packedIndex(dimension + i, dimension + j)] = entry;
          (*hessian)[packedIndex(dimension + i, j)] = -entry;
        }
    }
    return (0.5 * stiffness * restLength) * strain * strain;
  }

  /// Relative change of length.
  double violation(const std::array<double, coordinates>& x) const {
    double squared = 0;
    for (int i = 0; i < dimension; ++i) squared += (x[dimension + i] - x[i]) * (x[dimension + i] - x[i]);
    return std::abs(std::sqrt(squared) / restLength - 1);
  }

 private:
  template <class T>
  T strainOf(const T& squaredLength) const {
    return (0.5 / (restLength * restLength)) * squaredLength - 0.5;
  }
};

/// Keeps a joint at its place in a bar: E = ½ (K / l) |r|², with r the joint's distance from where the bar's other
/// joints put it, linear in their positions, and l the bar's length. Its Hessian is constant.
template <int dimension, int n>
struct RigidJointElement {
  static constexpr int coordinates = n * dimension;
  static constexpr std::string_view name = "rigid_joint";

  NodeCombination<dimension, n> offset;  ///< r
  double stiffness;                      ///< K [N]
  double barLength;                      ///< l [m]

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian) const {
    const std::array<T, dimension> r = offset.value(x);
    std::array<T, dimension> g;
    T squared = 0.0;
    for (int i = 0; i < dimension; ++i) {
      g[i] = (stiffness / barLength) * r[i];
      squared += r[i] * r[i];
    }
    if (gradient) offset.pullGradient(g, *gradient);
    if (hessian) {
      std::array<T, packedSize(dimension)> h;
      for (int i = 0; i < dimension; ++i) {
        for (int j = 0; j < i; ++j) h[packedIndex(i, j)] = 0.0;
        h[packedIndex(i, i)] = stiffness / barLength;
      }
      offset.pullHessian(h, *hessian);
    }
    return (0.5 * stiffness / barLength) * squared;
  }

  /// The joint's distance from its place over the bar's length: about the change of angle [rad].
  double violation(const std::array<double, coordinates>& x) const {
    double squared = 0;
    for (const double r : offset.value(x)) squared += r * r;
    return std::sqrt(squared) / barLength;
  }
};

/// A spring between two points that move with links (or between one and a fixed place).
template <int dimension, int n>
struct LocalSpringElement {
  static constexpr int coordinates = n * dimension;
  static constexpr std::string_view name = "local_spring";

  SpringLaw law;
  double restLength;
  NodeCombination<dimension, n> difference;

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian) const {
    std::array<T, dimension> g;
    std::array<T, packedSize(dimension)> h;
    const T energy = evaluateDistance<T, dimension>(law, restLength, difference.value(x), g, h);
    if (gradient) difference.pullGradient(g, *gradient);
    if (hessian) difference.pullHessian(h, *hessian);
    return energy;
  }
};

}  // namespace pliant::mechanics
