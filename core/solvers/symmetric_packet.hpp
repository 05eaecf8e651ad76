#pragma once

#include <algorithm>
#include <array>

#include "core/math/packet.hpp"

namespace pliant::solvers {

using math::Packet;

inline Packet maximum(const Packet& p, const Packet& q) {
  return Packet::map(
      [](const Packet::Register& x, const Packet::Register& y) -> Packet::Register { return x > y ? x : y; }, p, q);
}

inline Packet minimum(const Packet& p, const Packet& q) { return -maximum(-p, -q); }

inline double sumOf(const Packet& p) {
  double sum = 0;
  for (int lane = 0; lane < Packet::width; ++lane) sum += p[lane];
  return sum;
}

inline double largestOf(const Packet& p) {
  double largest = p[0];
  for (int lane = 1; lane < Packet::width; ++lane) largest = std::max(largest, p[lane]);
  return largest;
}

/// Symmetric 2 x 2 matrices, eight at once.
struct SymmetricPacket {
  Packet a, b, c;  ///< entries 00, 11 and 01

  friend SymmetricPacket operator+(const SymmetricPacket& p, const SymmetricPacket& q) {
    return {p.a + q.a, p.b + q.b, p.c + q.c};
  }
  friend SymmetricPacket operator-(const SymmetricPacket& p, const SymmetricPacket& q) {
    return {p.a - q.a, p.b - q.b, p.c - q.c};
  }
  friend SymmetricPacket operator-(const SymmetricPacket& p) { return {-p.a, -p.b, -p.c}; }
  friend SymmetricPacket operator*(const Packet& factor, const SymmetricPacket& p) {
    return {factor * p.a, factor * p.b, factor * p.c};
  }
  SymmetricPacket& operator+=(const SymmetricPacket& q) { return *this = *this + q; }

  Packet trace() const { return a + b; }
  Packet determinant() const { return a * b - c * c; }
  SymmetricPacket adjugate() const { return {b, a, -c}; }
};

/// Σ p_ij q_ij.
inline Packet dot(const SymmetricPacket& p, const SymmetricPacket& q) {
  return p.a * q.a + p.b * q.b + 2.0 * (p.c * q.c);
}

/// t x t.
inline SymmetricPacket congruence(const SymmetricPacket& t, const SymmetricPacket& x) {
  const Packet across = t.a * t.b + t.c * t.c;
  return {t.a * t.a * x.a + 2.0 * (t.a * t.c) * x.c + t.c * t.c * x.b,
          t.c * t.c * x.a + 2.0 * (t.b * t.c) * x.c + t.b * t.b * x.b,
          t.a * t.c * x.a + across * x.c + t.b * t.c * x.b};
}

/// ½ (p q + q p).
inline SymmetricPacket symmetricProduct(const SymmetricPacket& p, const SymmetricPacket& q) {
  return {p.a * q.a + p.c * q.c, p.b * q.b + p.c * q.c, 0.5 * (p.c * q.trace() + q.c * p.trace())};
}

/// x with ½ (v x + x v) = r, v positive definite.
inline SymmetricPacket solveSymmetricProduct(const SymmetricPacket& v, const SymmetricPacket& r) {
  const Packet z = (2.0 * r.c * (v.a * v.b) - v.c * (r.a * v.b + r.b * v.a)) / (v.trace() * v.determinant());
  return {(r.a - v.c * z) / v.a, (r.b - v.c * z) / v.b, z};
}

/// p with its eigenvalues changed by `change`.
template <class Change>
SymmetricPacket mapEigenvalues(const SymmetricPacket& p, const Change& change) {
  const Packet half = 0.5 * (p.a - p.b), mean = 0.5 * p.trace();
  const Packet radius = sqrt(half * half + p.c * p.c);
  const Packet high = change(mean + radius), low = change(mean - radius);
  const Packet ratio = 0.5 * (high - low) / maximum(radius, 1e-300);
  const Packet middle = 0.5 * (high + low);
  return {middle + ratio * half, middle - ratio * half, ratio * p.c};
}

/// factor v vᵀ.
inline SymmetricPacket scaledOuter(const Packet& factor, const std::array<double, 2>& v) {
  return {factor * (v[0] * v[0]), factor * (v[1] * v[1]), factor * (v[0] * v[1])};
}

/// vᵀ p v.
inline Packet along(const SymmetricPacket& p, const std::array<double, 2>& v) {
  return p.a * (v[0] * v[0]) + p.b * (v[1] * v[1]) + p.c * (2 * v[0] * v[1]);
}

/// A linear map F from 2 to 3 dimensions, by columns.
struct MapPacket {
  std::array<Packet, 3> first, second;

  /// FᵀF.
  SymmetricPacket metric() const {
    return {first[0] * first[0] + first[1] * first[1] + first[2] * first[2],
            second[0] * second[0] + second[1] * second[1] + second[2] * second[2],
            first[0] * second[0] + first[1] * second[1] + first[2] * second[2]};
  }
};

/// Symmetric part of FᵀG.
inline SymmetricPacket symmetricPart(const MapPacket& f, const MapPacket& g) {
  SymmetricPacket e{0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    e.a += f.first[i] * g.first[i];
    e.b += f.second[i] * g.second[i];
    e.c += f.first[i] * g.second[i] + f.second[i] * g.first[i];
  }
  e.c = 0.5 * e.c;
  return e;
}

}  // namespace pliant::solvers
