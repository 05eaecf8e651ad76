#include "ui/render/opengl_window.hpp"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

#include <algorithm>
#include <cstring>

namespace pliant::render {

OpenGLWindow::OpenGLWindow() {
  SetFrameBlitModeToNoBlit();
  SetOwnContext(0);
  SetMultiSamples(0);
  SetSupportsOpenGL(1);
  SetIsDirect(1);
}

void OpenGLWindow::OpenGLInitContext() {
  if (this->Initialized) return;
  glewExperimental = GL_TRUE;
  const GLenum outcome = glewInit();
  this->GlewInitValid = outcome == GLEW_OK || outcome == GLEW_ERROR_NO_GLX_DISPLAY;
  if (!this->GlewInitValid || !GLEW_VERSION_3_2) {
    vtkErrorMacro("OpenGL 3.2 is needed: " << glewGetErrorString(outcome));
    return;
  }
  this->Initialized = true;
}

void OpenGLWindow::readPixels(Image& image, ChannelOrder order) {
  const int* size = GetSize();
  const std::size_t row = 4 * static_cast<std::size_t>(size[0]);
  image.width = size[0];
  image.height = size[1];
  image.pixels.resize(row * size[1]);
  MakeCurrent();
  GetState()->PushReadFramebufferBinding();
  GetDisplayFramebuffer()->Bind(GL_READ_FRAMEBUFFER);
  GetDisplayFramebuffer()->ActivateReadBuffer(0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  const bool bytes = order == ChannelOrder::rgbaBytes;
  glReadPixels(0, 0, size[0], size[1], bytes ? GL_RGBA : GL_BGRA,
               bytes ? GL_UNSIGNED_BYTE : GL_UNSIGNED_INT_8_8_8_8_REV, image.pixels.data());
  GetState()->PopReadFramebufferBinding();
  // OpenGL counts rows from the bottom.
  for (int top = 0, bottom = size[1] - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(&image.pixels[top * row], &image.pixels[top * row] + row, &image.pixels[bottom * row]);
  if (bytes)
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
}

}  // namespace pliant::render
