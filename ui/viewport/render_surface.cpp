#include "ui/viewport/render_surface.hpp"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QStringList>

#include "ui/viewport/gl_surface.hpp"
#include "ui/viewport/soft_surface.hpp"

namespace pliant::viewport {
namespace {

bool openGLWorks() {
  static const QStringList without{"offscreen", "minimal", "vnc", "linuxfb"};
  if (qEnvironmentVariable("PLIANT_SURFACE") == "software" || without.contains(QGuiApplication::platformName()))
    return false;
  QOpenGLContext context;
  context.setFormat(glSurfaceFormat());
  QOffscreenSurface surface;
  surface.setFormat(context.format());
  surface.create();
  if (!context.create() || !surface.isValid() || !context.makeCurrent(&surface)) return false;
  const bool newEnough = context.format().version() >= qMakePair(3, 2);
  context.doneCurrent();
  return newEnough;
}

}  // namespace

std::unique_ptr<RenderSurface> makeRenderSurface(QWidget* parent) {
  static const bool useOpenGL = openGLWorks();
  if (useOpenGL) return makeGlSurface(parent);
  return makeSoftSurface(parent);
}

}  // namespace pliant::viewport
