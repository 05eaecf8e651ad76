#pragma once

#include "ui/viewport/render_surface.hpp"

namespace pliant::viewport {

/// Draws in memory and paints the picture with QPainter. Throws std::runtime_error as render::makeOffscreenContext()
/// does.
std::unique_ptr<RenderSurface> makeSoftSurface(QWidget* parent);

}  // namespace pliant::viewport
