#pragma once

#include <vector>

#include "core/scene/polar_curves.hpp"
#include "ui/render/image.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// Draws polar plots side by side (thesis Figs. 4.6, 4.7), without a display. Throws as renderToImage() does.
Image drawPolarCurves(const std::vector<scene::PolarCurves>& plots, int width, int height, Theme theme);

}  // namespace pliant::render
