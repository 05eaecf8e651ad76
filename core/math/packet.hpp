#pragma once

#include <cmath>
#include <cstring>

namespace pliant::math {

/// Eight doubles that behave like one: element formulas are written once as templates over the scalar and evaluated
/// for eight time samples together. Made of vectors that fit the target's registers, because the compiler splits wider
/// ones by way of memory.
struct Packet {
  static constexpr int width = 8;
#if defined(__AVX512F__)
  static constexpr int lanes = 8;
#elif defined(__AVX__)
  static constexpr int lanes = 4;
#else
  static constexpr int lanes = 2;
#endif
  static constexpr int registerCount = width / lanes;
  using Register = double __attribute__((vector_size(lanes * sizeof(double))));

  Register registers[registerCount];

  Packet() : Packet(0.0) {}
  Packet(double value) {  // implicit on purpose: formulas mix packets and constants
    for (Register& r : registers) r = Register{} + value;
  }
  // Copied by registers: copying as a block of memory halves the speed (16-byte stores, then 32-byte loads).
  Packet(const Packet& other) { *this = other; }
  Packet& operator=(const Packet& other) {
    for (int i = 0; i < registerCount; ++i) registers[i] = other.registers[i];
    return *this;
  }

  double operator[](int lane) const { return registers[lane / lanes][lane % lanes]; }

  /// `operation`, on registers, applied to all.
  template <class Operation, class... Packets>
  static Packet map(const Operation& operation, const Packets&... packets) {
    Packet result;
    for (int i = 0; i < registerCount; ++i) result.registers[i] = operation(packets.registers[i]...);
    return result;
  }

  friend Packet operator+(const Packet& a, const Packet& b) {
    return map([](const Register& p, const Register& q) -> Register { return p + q; }, a, b);
  }
  friend Packet operator-(const Packet& a, const Packet& b) {
    return map([](const Register& p, const Register& q) -> Register { return p - q; }, a, b);
  }
  friend Packet operator*(const Packet& a, const Packet& b) {
    return map([](const Register& p, const Register& q) -> Register { return p * q; }, a, b);
  }
  friend Packet operator/(const Packet& a, const Packet& b) {
    return map([](const Register& p, const Register& q) -> Register { return p / q; }, a, b);
  }
  friend Packet operator-(const Packet& a) {
    return map([](const Register& p) -> Register { return -p; }, a);
  }
  Packet& operator+=(const Packet& b) { return *this = *this + b; }
  Packet& operator-=(const Packet& b) { return *this = *this - b; }
  Packet& operator*=(const Packet& b) { return *this = *this * b; }
  Packet& operator/=(const Packet& b) { return *this = *this / b; }

  friend Packet sqrt(const Packet& a) { return map(squareRoot, a); }
  /// Within 2 units in the last place of std::atan2; the sign of a zero does not count.
  friend Packet atan2(const Packet& y, const Packet& x) { return map(arcTangent, y, x); }

 private:
  static Register squareRoot(const Register& a) {
    Register root;
    for (int i = 0; i < lanes; ++i) root[i] = std::sqrt(a[i]);
    return root;
  }

  /// The angle is brought below π/8 by its symmetries, and atan(t) = t + t³ P(t²) there, with the polynomial P of
  /// degree 10 that has the smallest largest error (relative to the result 5e-18, before rounding).
  static Register arcTangent(const Register& y, const Register& x) {
    constexpr double tangentOfEighth = 0.41421356237309503;  // of π/8
    constexpr double coefficients[] = {-0x1.3a31b1c0fd3b7p-6, 0x1.4162c02b1dda3p-5,  -0x1.a0999c632b6edp-5,
                                       0x1.dfe6497e96323p-5,  -0x1.10fa77b1a6d57p-4, 0x1.3b1263064f6b9p-4,
                                       -0x1.745d0b28a7e37p-4, 0x1.c71c71853d7fap-4,  -0x1.2492492436201p-3,
                                       0x1.999999999934cp-3,  -0x1.5555555555555p-2};
    const Register zero{}, one = zero + 1.0;
    const Register absoluteX = x < zero ? -x : x, absoluteY = y < zero ? -y : y;
    const auto isSteep = absoluteY > absoluteX;
    const Register smaller = isSteep ? absoluteX : absoluteY, larger = isSteep ? absoluteY : absoluteX;
    const auto isAbove = smaller > tangentOfEighth * larger;
    const Register denominator = isAbove ? larger + smaller : larger;
    const Register t = (isAbove ? smaller - larger : smaller) / (denominator == zero ? one : denominator);
    const Register squared = t * t;
    Register polynomial = zero;
    for (const double c : coefficients) polynomial = polynomial * squared + c;
    Register angle = t + t * (squared * polynomial);
    angle = isAbove ? M_PI_4 + angle : angle;
    angle = isSteep ? M_PI_2 - angle : angle;
    angle = x < zero ? M_PI - angle : angle;
    return y < zero ? -angle : angle;
  }
};

/// How many samples one evaluation with the scalar `T` covers.
template <class T>
inline constexpr int laneCount = 1;
template <>
inline constexpr int laneCount<Packet> = Packet::width;

inline void load(const double* from, double& to) { to = *from; }
inline void load(const double* from, Packet& to) {
  for (int i = 0; i < Packet::registerCount; ++i)  // register by register, as copying one goes
    std::memcpy(&to.registers[i], from + i * Packet::lanes, sizeof(Packet::Register));
}

inline void store(double* to, const Packet& value) {
  for (int i = 0; i < Packet::registerCount; ++i)
    std::memcpy(to + i * Packet::lanes, &value.registers[i], sizeof(Packet::Register));
}

inline void addTo(double* to, double value) { *to += value; }
inline void addTo(double* to, const Packet& value) {
  Packet sum;
  load(to, sum);
  store(to, sum + value);
}

}  // namespace pliant::math
