#pragma once

#include <QImage>
#include <QString>
#include <functional>
#include <memory>

class QWidget;
class vtkRenderWindow;

namespace pliant::viewport {

/// A widget that shows a VTK window. It renders when Qt paints it, and only then.
class RenderSurface {
 public:
  virtual ~RenderSurface() = default;
  RenderSurface() = default;
  RenderSurface(const RenderSurface&) = delete;
  RenderSurface& operator=(const RenderSurface&) = delete;

  virtual QWidget* widget() = 0;
  virtual vtkRenderWindow* window() = 0;
  /// Renders anew with the next paint event.
  virtual void requestRender() = 0;
  /// The present picture at the screen's resolution.
  virtual QImage grabImage() = 0;
  /// "OpenGL" or "software".
  virtual QString name() const = 0;
  /// Whether the processor draws, be it through OpenGL: fine pictures then take too long for motion.
  virtual bool drawsInSoftware() const = 0;

  /// Called when the window has got another size, with the pixels per device-independent pixel.
  std::function<void(double pixelRatio)> onResize;
};

/// OpenGL where it works, else Mesa's software renderer: on platforms without OpenGL (offscreen, minimal, vnc,
/// linuxfb), where no context can be made, or if the environment variable PLIANT_SURFACE is "software". Throws
/// std::runtime_error if the software renderer is needed and missing.
std::unique_ptr<RenderSurface> makeRenderSurface(QWidget* parent);

}  // namespace pliant::viewport
