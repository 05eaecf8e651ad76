#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/cloth/stretch_limit.hpp"
#include "ui/render/theme.hpp"

class vtkContext2D;

namespace pliant::render {

/// Pixels from the bottom left.
struct Rectangle {
  double left = 0, bottom = 0, width = 0, height = 0;
};

/// Text around `place`, which is at the fraction `anchor` of its box: (0.5, 0.5) its middle, (0, 0) its bottom left.
void paintText(vtkContext2D& painter, const Eigen::Vector2d& place, const Eigen::Vector2d& anchor,
               const std::string& text, double size, const Color& color);

/// Stretch limits in polar coordinates: warp to the right, weft up, and the rest shape a circle in the middle. The
/// scale begins within it, so that small stretches are seen. Where a limit is enforced in sampled directions alone,
/// those are dots. `pixelRatio`: pixels per device-independent pixel.
void paintPolar(vtkContext2D& painter, const Rectangle& place, const std::vector<cloth::StretchLimit>& limits,
                const std::vector<cloth::LimitConstraints>& constraints, double pixelRatio, Theme theme);

}  // namespace pliant::render
