#pragma once

#include <QSurfaceFormat>

#include "ui/viewport/render_surface.hpp"

namespace pliant::viewport {

/// OpenGL 3.2 core, as VTK needs it.
QSurfaceFormat glSurfaceFormat();

/// Draws with the machine's OpenGL. Only where a context can be made: a QOpenGLWidget crashes elsewhere.
std::unique_ptr<RenderSurface> makeGlSurface(QWidget* parent);

}  // namespace pliant::viewport
