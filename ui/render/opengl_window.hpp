#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

#include "ui/render/image.hpp"

namespace pliant::render {

/// A VTK window that draws into an OpenGL context made by somebody else; derived classes say how that becomes current.
class OpenGLWindow : public vtkGenericOpenGLRenderWindow {
 public:
  vtkTypeMacro(OpenGLWindow, vtkGenericOpenGLRenderWindow)

      /// Debian's GLEW is built for GLX: under EGL and OSMesa it has loaded its functions when it complains that there
      /// is no GLX display, which is therefore accepted.
      void OpenGLInitContext() override;

  bool IsCurrent() override = 0;
  void MakeCurrent() override = 0;

  /// The picture last rendered.
  void readPixels(Image& image, ChannelOrder order = ChannelOrder::rgbaBytes);

 protected:
  OpenGLWindow();
};

}  // namespace pliant::render
