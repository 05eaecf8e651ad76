#include "core/base/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"

namespace pliant::base {
namespace {

constexpr double pi = std::numbers::pi;

/// scale * 10^decimals SI units of `dimension`. The decimal part is kept apart so that "12.4 g" is read as the number
/// nearest to 0.0124.
struct Unit {
  Dimension dimension;
  double scale = 1;
  int decimals = 0;
};

struct NamedUnit {
  std::string_view symbol;
  Unit unit;
  bool takesPrefix = false;
};

constexpr Dimension energyDimension{1, 2, -2, 0};
constexpr Dimension powerDimension{1, 2, -3, 0};

constexpr std::array namedUnits{
    NamedUnit{"m", {dimensions::length}, true},
    NamedUnit{"kg", {dimensions::mass}},
    NamedUnit{"g", {dimensions::mass, 1, -3}, true},
    NamedUnit{"t", {dimensions::mass, 1, 3}},
    NamedUnit{"s", {dimensions::time}, true},
    NamedUnit{"min", {dimensions::time, 60}},
    NamedUnit{"rad", {dimensions::angle}, true},
    NamedUnit{"deg", {dimensions::angle, pi / 180}},
    NamedUnit{"°", {dimensions::angle, pi / 180}},
    NamedUnit{"Hz", {dimensions::angularFrequency, 2 * pi}, true},
    NamedUnit{"rpm", {dimensions::angularFrequency, 2 * pi / 60}},
    NamedUnit{"N", {dimensions::force}, true},
    NamedUnit{"Pa", {dimensions::pressure}, true},
    NamedUnit{"J", {energyDimension}, true},
    NamedUnit{"W", {powerDimension}, true},
    NamedUnit{"%", {dimensions::none, 1, -2}},
    NamedUnit{"1", {dimensions::none}},
};

struct Prefix {
  std::string_view symbol;
  int decimals;
};

constexpr std::array prefixes{Prefix{"n", -9}, Prefix{"µ", -6}, Prefix{"μ", -6}, Prefix{"u", -6},
                              Prefix{"m", -3}, Prefix{"c", -2}, Prefix{"d", -1}, Prefix{"k", 3},
                              Prefix{"M", 6},  Prefix{"G", 9},  Prefix{"T", 12}};

std::optional<Unit> findUnit(std::string_view symbol) {
  for (const NamedUnit& named : namedUnits)
    if (named.symbol == symbol) return named.unit;
  for (const Prefix& prefix : prefixes) {
    if (!symbol.starts_with(prefix.symbol)) continue;
    for (const NamedUnit& named : namedUnits) {
      if (!named.takesPrefix || named.symbol != symbol.substr(prefix.symbol.size())) continue;
      Unit unit = named.unit;
      unit.decimals += prefix.decimals;
      return unit;
    }
  }
  return std::nullopt;
}

Unit power(const Unit& unit, int exponent) {
  const Dimension& d = unit.dimension;
  return {{d.mass * exponent, d.length * exponent, d.time * exponent, d.angle * exponent},
          std::pow(unit.scale, exponent),
          unit.decimals * exponent};
}

Unit product(const Unit& a, const Unit& b) {
  return {{a.dimension.mass + b.dimension.mass, a.dimension.length + b.dimension.length,
           a.dimension.time + b.dimension.time, a.dimension.angle + b.dimension.angle},
          a.scale * b.scale,
          a.decimals + b.decimals};
}

[[noreturn]] void fail(const std::string& problem) { throw InputError("", problem); }

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string quoted = "\"";
  for (const char c : text.substr(0, longest)) quoted += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  return quoted + (text.size() > longest ? "...\"" : "\"");
}

void skipSpaces(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
}

/// Removes `token` from the front of `text` if it stands there.
bool take(std::string_view& text, std::string_view token) {
  if (!text.starts_with(token)) return false;
  text.remove_prefix(token.size());
  return true;
}

int takeExponent(std::string_view& text, std::string_view whole) {
  if (take(text, "²")) return 2;
  if (take(text, "³")) return 3;
  if (!take(text, "^")) return 1;
  int exponent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  if (error != std::errc() || exponent < -9 || exponent > 9)
    fail("The unit " + quote(whole) + " has an exponent that is no whole number between -9 and 9.");
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return exponent;
}

/// unit := factor { ("*" | "·" | " " | "/") factor }, factor := symbol [exponent]; "/" divides by the next factor
/// alone.
Unit parseUnit(const std::string_view whole) {
  std::string_view text = whole;
  Unit result;
  bool divide = false;
  while (true) {
    skipSpaces(text);
    std::size_t length = 0;
    while (length < text.size() && std::string_view("^*/ ").find(text[length]) == std::string_view::npos &&
           !text.substr(length).starts_with("²") && !text.substr(length).starts_with("³") &&
           !text.substr(length).starts_with("·"))
      ++length;
    const std::string_view symbol = text.substr(0, length);
    text.remove_prefix(length);
    const std::optional<Unit> unit = findUnit(symbol);
    if (!unit && symbol.empty()) fail("The unit " + quote(whole) + " is incomplete.");
    if (!unit) fail("The unit " + quote(symbol) + " is not known.");
    const int exponent = takeExponent(text, whole);
    result = product(result, power(*unit, divide ? -exponent : exponent));
    skipSpaces(text);
    if (text.empty()) return result;
    divide = take(text, "/");
    if (!divide && !take(text, "*")) take(text, "·");
  }
}

/// A cycle counts as 2π rad where an angular frequency is expected, and as a pure number elsewhere.
bool adapt(Unit& unit, const Dimension& expected, std::string_view text) {
  if (unit.dimension == expected) return true;
  if (text.find("Hz") == std::string_view::npos) return false;
  unit.dimension.angle -= 1;
  unit.scale /= 2 * pi;
  return unit.dimension == expected;
}

/// The number nearest to text * 10^decimals; `text` is a decimal number that from_chars has accepted.
double shiftedNumber(std::string_view text, int decimals) {
  const std::size_t e = text.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    const char* begin = text.data() + e + 1;
    if (*begin == '+') ++begin;
    std::from_chars(begin, text.data() + text.size(), exponent);
  }
  const std::string shifted = std::string(text.substr(0, e)) + "e" + std::to_string(exponent + decimals);
  double value = 0;
  const auto [end, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (error == std::errc::result_out_of_range)
    fail(quote(text) + " is too large or too small for a number in SI units.");
  return value;
}

std::string unitOf(const Dimension& dimension) {
  const std::string unit = siUnit(dimension);
  return unit.empty() ? "a number without a unit" : "a value in " + unit;
}

}  // namespace

double parseQuantity(std::string_view text, const Dimension& expected) {
  const std::string_view whole = text;
  skipSpaces(text);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const std::size_t digits = text.starts_with('-') ? 1 : 0;
  double number = 0;
  const bool looksLikeNumber =
      digits < text.size() && (text[digits] == '.' || (text[digits] >= '0' && text[digits] <= '9'));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!looksLikeNumber || error == std::errc::invalid_argument)
    fail(quote(whole) + " is no finite number; expected " + unitOf(expected) + ".");
  if (error == std::errc::result_out_of_range) fail(quote(whole) + " is too large or too small for a number.");
  const std::string_view numberText = text.substr(0, static_cast<std::size_t>(end - text.data()));
  text.remove_prefix(numberText.size());
  skipSpaces(text);
  if (text.empty()) return number;

  Unit unit = parseUnit(text);
  if (!adapt(unit, expected, text)) fail(quote(whole) + " has the wrong unit; expected " + unitOf(expected) + ".");
  const double value = (unit.decimals == 0 ? number : shiftedNumber(numberText, unit.decimals)) * unit.scale;
  if (!std::isfinite(value)) fail(quote(whole) + " is too large for a number.");
  return value;
}

std::string siUnit(const Dimension& dimension) {
  if (dimension == dimensions::none) return "";
  std::string numerator, denominator;
  Dimension rest = dimension;
  const auto add = [&](std::string_view symbol, int exponent) {
    if (exponent == 0) return;
    std::string& side = exponent > 0 ? numerator : denominator;
    if (exponent < 0)
      side += "/";
    else if (!side.empty())
      side += " ";
    side += symbol;
    if (std::abs(exponent) != 1) side.append("^").append(std::to_string(std::abs(exponent)));
  };
  if (dimension == dimensions::pressure) return "Pa";
  if (dimension == energyDimension) return "J";
  if (dimension == powerDimension) return "W";
  if (dimension.mass == 1 && dimension.time == -2) {  // N, N/m, N/m^3, ...
    add("N", 1);
    rest = {0, dimension.length - 1, 0, dimension.angle};
  }
  add("kg", rest.mass);
  add("m", rest.length);
  add("rad", rest.angle);
  add("s", rest.time);
  return (numerator.empty() ? "1" : numerator) + denominator;
}

namespace {

/// How a dimension is shown: the unit after the prefix, its size in SI, and the prefixes that people use with it.
struct DisplayUnit {
  std::string symbol;
  double size = 1;
  int smallest = 0;  ///< decimal exponents of the prefixes, multiples of 3
  int largest = 0;
};

DisplayUnit displayUnit(const Dimension& dimension) {
  if (dimension == dimensions::mass) return {"g", 1e-3, -6, 3};
  if (dimension == dimensions::length) return {"m", 1, -9, 3};
  if (dimension == dimensions::time) return {"s", 1, -9, 0};
  if (dimension == dimensions::angle) return {"deg", pi / 180, 0, 0};
  const std::string unit = siUnit(dimension);
  const bool prefixed = unit.starts_with('N') || unit == "Pa" || unit == "J" || unit == "W";
  return {unit, 1, prefixed ? -9 : 0, prefixed ? 12 : 0};
}

std::string_view prefixSymbol(int decimals) {
  for (const Prefix& prefix : prefixes)
    if (prefix.decimals == decimals) return prefix.symbol;
  return "";
}

std::string toText(double value, std::chars_format format, int precision) {
  std::array<char, 64> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, precision);
  return {buffer.data(), end};
}

std::string withUnit(std::string number, const std::string& unit) {
  return unit.empty() ? number : std::move(number) + " " + unit;
}

}  // namespace

std::string formatQuantity(double value, const Dimension& dimension) {
  constexpr int digits = 4;
  const DisplayUnit unit = displayUnit(dimension);
  if (!std::isfinite(value / unit.size)) return formatQuantityExactly(value, dimension);
  if (value == 0) return withUnit("0", unit.symbol);
  // Rounded first, so that 999.96 mm becomes 1.000 m.
  const std::string rounded = toText(value / unit.size, std::chars_format::scientific, digits - 1);
  int exponent = 0;
  const char* exponentText = rounded.data() + rounded.find('e') + 1;
  if (*exponentText == '+') ++exponentText;
  std::from_chars(exponentText, rounded.data() + rounded.size(), exponent);
  const int thousands = static_cast<int>(std::floor(exponent / 3.0)) * 3;
  const int prefix = std::clamp(thousands, unit.smallest, unit.largest);
  const std::string symbol = std::string(prefixSymbol(prefix)) + unit.symbol;
  const int leading = exponent - prefix;  // decimal exponent of the number that is shown
  const double shown = shiftedNumber(rounded, -prefix);
  if (leading < -3 || leading > 5) return withUnit(toText(shown, std::chars_format::scientific, digits - 1), symbol);
  return withUnit(toText(shown, std::chars_format::fixed, std::max(0, digits - 1 - leading)), symbol);
}

std::string formatQuantityExactly(double value, const Dimension& dimension) {
  std::array<char, 64> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return withUnit({buffer.data(), end}, siUnit(dimension));
}

}  // namespace pliant::base
