#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "ui/render/image.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// What tests look for in pictures.
struct Blob {
  int pixels = 0;
  double x = 0;  ///< of its middle, from the top left
  double y = 0;
  int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;
};

using PixelTest = std::function<bool(int red, int green, int blue)>;

/// The pixels that pass `wanted`, without the bottom left corner, where the gizmo stands (`corner` pixels wide).
inline Blob findBlob(const Image& image, const PixelTest& wanted, int corner = 100) {
  Blob blob;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = &image.pixels[4 * (static_cast<std::size_t>(y) * image.width + x)];
      if ((x < corner && y >= image.height - corner) || !wanted(p[0], p[1], p[2])) continue;
      ++blob.pixels;
      blob.x += x + 0.5;
      blob.y += y + 0.5;
      blob.left = std::min(blob.left, x);
      blob.right = std::max(blob.right, x);
      blob.top = std::min(blob.top, y);
      blob.bottom = std::max(blob.bottom, y);
    }
  if (blob.pixels > 0) {
    blob.x /= blob.pixels;
    blob.y /= blob.pixels;
  }
  return blob;
}

/// Saturated blue, as only point masses are where no field is shown.
inline bool isMassBlue(int red, int green, int blue) { return blue > red + 60 && blue > green + 25; }

inline PixelTest differsFrom(const Color& color) {
  return [color](int red, int green, int blue) {
    const int channels[] = {red, green, blue};
    for (int i = 0; i < 3; ++i)
      if (std::abs(channels[i] - 255 * color[i]) > 3) return true;
    return false;
  };
}

}  // namespace pliant::render
