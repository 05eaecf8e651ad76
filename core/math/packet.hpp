#pragma once

#include <cmath>
#include <cstring>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

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
  /// Both within 4e-16 of the exact values, for |angle| up to 1e5.
  friend void sineAndCosine(const Packet& angle, Packet& sine, Packet& cosine) {
    for (int i = 0; i < registerCount; ++i) sineAndCosine(angle.registers[i], sine.registers[i], cosine.registers[i]);
  }

 private:
  static Register squareRoot(const Register& a) {
    // Named, because the compiler would go through the lanes one by one to set errno where a number is negative.
#if defined(__AVX512F__)
    return _mm512_sqrt_pd(a);
#elif defined(__AVX__)
    return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(a);
#else
    Register root;
    for (int i = 0; i < lanes; ++i) root[i] = std::sqrt(a[i]);
    return root;
#endif
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

  /// The nearest multiple of π/2 is taken off, in three parts so that nothing is lost, and the Taylor series do the
  /// rest (|t| <= π/4: their first terms left out are below 6e-17).
  static void sineAndCosine(const Register& angle, Register& sine, Register& cosine) {
    using Integers = long long __attribute__((vector_size(lanes * sizeof(long long))));
    constexpr double shift = 0x1.8p52;  // adding it rounds to a whole number, which then stands in the lowest bits
    constexpr double halfPi[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};  // 33, 33 and 53 bits
    const Register shifted = angle * M_2_PI + shift, multiple = shifted - shift;
    const Register t = ((angle - multiple * halfPi[0]) - multiple * halfPi[1]) - multiple * halfPi[2];
    const Register squared = t * t;
    Register odd{}, even{};
    for (double n = 14; n >= 2; n -= 2) {
      odd = (odd + 1.0) * squared * (-1 / (n * (n + 1)));
      even = (even + 1.0) * squared * (-1 / ((n + 1) * (n + 2)));
    }
    odd = t + t * odd;
    even = (even + 1.0) * squared * -0.5 + 1.0;
    Integers quadrant;
    std::memcpy(&quadrant, &shifted, sizeof(quadrant));
    const auto isSwapped = (quadrant & 1) != 0;
    sine = isSwapped ? even : odd;
    cosine = isSwapped ? odd : even;
    sine = (quadrant & 2) != 0 ? -sine : sine;
    cosine = ((quadrant + 1) & 2) != 0 ? -cosine : cosine;
  }
};

inline void sineAndCosine(double angle, double& sine, double& cosine) {
  sine = std::sin(angle);
  cosine = std::cos(angle);
}

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
