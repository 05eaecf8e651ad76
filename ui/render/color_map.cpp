#include "ui/render/color_map.hpp"

#include <vtkLookupTable.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pliant::render {

Color viridis(double fraction) {
  // Twenty equidistant colours of viridis (van der Walt and Smith 2015, CC0), linear in between.
  static constexpr std::array<unsigned, 20> anchors{
      0x440154, 0x481568, 0x482677, 0x453781, 0x3f4788, 0x39558c, 0x32648e, 0x2d718e, 0x287d8e, 0x238a8d,
      0x1f968b, 0x20a386, 0x29af7f, 0x3cbc75, 0x56c667, 0x74d055, 0x94d840, 0xb8de29, 0xdce318, 0xfde725};
  const double place = std::clamp(fraction, 0.0, 1.0) * (anchors.size() - 1);
  const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), anchors.size() - 2);
  Color color;
  for (int channel = 0; channel < 3; ++channel) {
    const auto value = [&](std::size_t i) { return ((anchors[i] >> (16 - 8 * channel)) & 255) / 255.0; };
    color[channel] = std::lerp(value(below), value(below + 1), place - static_cast<double>(below));
  }
  return color;
}

Color faded(const Color& color) {
  const double grey = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
  Color result;
  for (int channel = 0; channel < 3; ++channel) result[channel] = std::lerp(color[channel], 0.25 + 0.5 * grey, 0.85);
  return result;
}

void setViridis(vtkLookupTable* table, double minimum, double maximum, bool stale) {
  constexpr int count = 256;
  table->SetNumberOfTableValues(count);
  table->SetTableRange(minimum, maximum);
  for (int i = 0; i < count; ++i) {
    const Color plain = viridis(i / (count - 1.0));
    const Color color = stale ? faded(plain) : plain;
    table->SetTableValue(i, color[0], color[1], color[2], 1.0);
  }
  table->Modified();
}

}  // namespace pliant::render
