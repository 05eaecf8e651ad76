#pragma once

#include <string>
#include <string_view>

namespace pliant::base {

/// A physical dimension: exponents of kilogram, metre, second and radian. An angle counts as a dimension, so that a
/// frequency written in Hz becomes an angular frequency (2 pi rad/s) where one is expected.
struct Dimension {
  int mass = 0;
  int length = 0;
  int time = 0;
  int angle = 0;

  friend bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimensions {
inline constexpr Dimension none{};
inline constexpr Dimension length{0, 1, 0, 0};
inline constexpr Dimension mass{1, 0, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension angularFrequency{0, 0, -1, 1};
inline constexpr Dimension rate{0, 0, -1, 0};  ///< 1/s, such as mass-proportional damping
inline constexpr Dimension density{1, -3, 0, 0};
inline constexpr Dimension pressure{1, -1, -2, 0};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension stiffness{1, 0, -2, 0};  ///< N/m
inline constexpr Dimension acceleration{0, 1, -2, 0};
}  // namespace dimensions

/// The SI value of `text`, such as "70.2 N/m", "3.3 GPa", "40 deg", "2.5 Hz", "12" (plain numbers are SI).
/// Throws InputError (with an empty location) if the text is no finite number, the unit is unknown, or it does not
/// have the expected dimension.
double parseQuantity(std::string_view text, const Dimension& expected);

/// The coherent SI unit of a dimension: "N/m", "Pa", "rad/s", "kg/m^3"; empty for a pure number.
std::string siUnit(const Dimension& dimension);

/// Four significant digits with a fitting prefix: "12.40 g", "3.300 GPa", "11.00 rad/s". The value is SI.
std::string formatQuantity(double value, const Dimension& dimension);

/// Every digit needed to read the same SI value back: "0.0124 kg".
std::string formatQuantityExactly(double value, const Dimension& dimension);

}  // namespace pliant::base
