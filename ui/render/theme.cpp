#include "ui/render/theme.hpp"

#include <cmath>

namespace pliant::render {
namespace {

constexpr Color rgb(unsigned value) {
  return {((value >> 16) & 255) / 255.0, ((value >> 8) & 255) / 255.0, (value & 255) / 255.0};
}

}  // namespace

const Palette& palette(Theme theme) {
  static const Palette light{.background = rgb(0xf7f8fa),
                             .text = rgb(0x22262b),
                             .edge = rgb(0x2a2f36),
                             .outline = rgb(0x16191d),
                             .rest = rgb(0xb8c0ca),
                             .link = rgb(0x434b55),
                             .spring = rgb(0x6d7884),
                             .mass = rgb(0x0072b2),
                             .driven = rgb(0xcc79a7),
                             .trajectory = rgb(0x009e73),
                             .prediction = rgb(0xd55e00)};
  static const Palette dark{.background = rgb(0x1e2227),
                            .text = rgb(0xe6e9ed),
                            .edge = rgb(0x15181c),
                            .outline = rgb(0xaab3bd),
                            .rest = rgb(0x7d8793),
                            .link = rgb(0xc3cad2),
                            .spring = rgb(0x9aa4b0),
                            .mass = rgb(0x56b4e9),
                            .driven = rgb(0xcc79a7),
                            .trajectory = rgb(0x1fc795),
                            .prediction = rgb(0xe69f00)};
  return theme == Theme::dark ? dark : light;
}

Color mixed(const Color& a, const Color& b, double part) {
  Color result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::lerp(a[i], b[i], part);
  return result;
}

}  // namespace pliant::render
