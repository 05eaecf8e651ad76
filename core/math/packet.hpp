#pragma once

#include <cmath>
#include <cstring>

namespace pliant::math {

/// Eight doubles that behave like one: element formulas are written once as templates over the scalar and evaluated
/// for eight time samples together. Uses the compiler's vector extension, so it follows the target's registers.
struct Packet {
  static constexpr int width = 8;
  using Lanes = double __attribute__((vector_size(width * sizeof(double))));

  Lanes lanes;

  Packet() : lanes{} {}
  Packet(double value) : lanes(Lanes{} + value) {}  // implicit on purpose: formulas mix packets and constants
  explicit Packet(const Lanes& values) : lanes(values) {}

  Packet& operator+=(const Packet& b) { lanes += b.lanes; return *this; }
  Packet& operator-=(const Packet& b) { lanes -= b.lanes; return *this; }
  Packet& operator*=(const Packet& b) { lanes *= b.lanes; return *this; }
  Packet& operator/=(const Packet& b) { lanes /= b.lanes; return *this; }

  friend Packet operator+(const Packet& a, const Packet& b) { return Packet(a.lanes + b.lanes); }
  friend Packet operator-(const Packet& a, const Packet& b) { return Packet(a.lanes - b.lanes); }
  friend Packet operator*(const Packet& a, const Packet& b) { return Packet(a.lanes * b.lanes); }
  friend Packet operator/(const Packet& a, const Packet& b) { return Packet(a.lanes / b.lanes); }
  friend Packet operator-(const Packet& a) { return Packet(-a.lanes); }

  friend Packet sqrt(const Packet& a) {
    Packet result;
    for (int i = 0; i < width; ++i) result.lanes[i] = std::sqrt(a.lanes[i]);
    return result;
  }
  friend Packet atan2(const Packet& y, const Packet& x) {
    Packet result;
    for (int i = 0; i < width; ++i) result.lanes[i] = std::atan2(y.lanes[i], x.lanes[i]);
    return result;
  }
};

/// How many samples one evaluation with the scalar `T` covers.
template <class T>
inline constexpr int laneCount = 1;
template <>
inline constexpr int laneCount<Packet> = Packet::width;

inline void load(const double* from, double& to) { to = *from; }
inline void load(const double* from, Packet& to) { std::memcpy(&to.lanes, from, sizeof(to.lanes)); }
inline void addTo(double* to, double value) { *to += value; }
inline void addTo(double* to, const Packet& value) {
  Packet sum;
  load(to, sum);
  sum += value;
  std::memcpy(to, &sum.lanes, sizeof(sum.lanes));
}

}  // namespace pliant::math
