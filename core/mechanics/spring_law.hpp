#pragma once

#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/spring.hpp"

namespace pliant::mechanics {

inline double inverseOrZero(double value) { return value > 0 ? 1 / value : 0; }
inline math::Packet inverseOrZero(const math::Packet& value) {
  return math::Packet::map(
      [](const math::Packet::Register& p) -> math::Packet::Register {
        return p > 0.0 ? 1.0 / p : math::Packet::Register{};
      },
      value);
}

/// Energy, force and stiffness of a spring law at the elongation `e`, and force / e.
template <class T>
struct LawValue {
  T energy = 0.0, force = 0.0, stiffness = 0.0, ratio = 0.0;

  LawValue(const SpringLaw& law, const T& e) {
    for (int i = static_cast<int>(law.coefficients.size()) - 1; i >= 0; --i) {
      const double c = law.coefficients[i];
      ratio = ratio * e + c;
      stiffness = stiffness * e + (i + 1) * c;
      energy = energy * e + c / (i + 2);
    }
    force = ratio * e;
    energy = energy * e * e;
  }
};

/// Derivatives of E(|r| - restLength) by r: the gradient f n, and the symmetric Hessian f' n nᵀ + f/|r| (I - n nᵀ)
/// packed. Where |r| = 0 the direction n is undefined: force and stiffness are zero there, but for restLength = 0,
/// where both have limits.
template <class T, int dimension>
T evaluateDistance(const SpringLaw& law, double restLength, const std::array<T, dimension>& r,
                   std::array<T, dimension>& gradient, std::array<T, packedSize(dimension)>& hessian) {
  using std::sqrt;
  T squared = 0.0;
  for (const T& component : r) squared += component * component;
  const T distance = sqrt(squared);
  const T inverse = inverseOrZero(distance);
  const LawValue<T> at(law, distance - restLength);
  const T ratio = restLength == 0 ? at.ratio : at.force * inverse;
  const T along = (at.stiffness - ratio) * inverse * inverse;
  for (int i = 0; i < dimension; ++i) {
    gradient[i] = ratio * r[i];
    for (int j = 0; j <= i; ++j) hessian[packedIndex(i, j)] = along * r[i] * r[j];
    hessian[packedIndex(i, i)] += ratio;
  }
  return at.energy;
}

}  // namespace pliant::mechanics
