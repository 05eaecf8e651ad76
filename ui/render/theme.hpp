#pragma once

#include <array>

namespace pliant::render {

enum class Theme { light, dark };

/// Red, green and blue in [0, 1].
using Color = std::array<double, 3>;

/// The colours of one theme. Categories are Okabe and Ito's, so that they are told apart by the colour-blind.
struct Palette {
  Color background;
  Color text;     ///< contrast with the background at least 4.5 : 1
  Color edge;     ///< of triangles
  Color outline;  ///< of surfaces
  Color rest;     ///< a surface without a field
  Color link;     ///< and rods
  Color spring;
  Color mass;
  Color driven;      ///< driven nodes
  Color trajectory;  ///< solved: green
  Color prediction;  ///< predicted: orange
};

const Palette& palette(Theme theme);

/// `a` where `part` is 0, `b` where it is 1.
Color mixed(const Color& a, const Color& b, double part);

}  // namespace pliant::render
