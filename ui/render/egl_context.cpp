#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "ui/render/dynamic_library.hpp"
#include "ui/render/offscreen_context.hpp"

namespace pliant::render {
namespace {

class EglContext final : public OffscreenContext {
 public:
  EglContext() {
    const auto extensions =
        library_.function<const char*(EGLDisplay, EGLint)>("eglQueryString")(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!extensions || std::string(extensions).find("EGL_MESA_platform_surfaceless") == std::string::npos)
      throw std::runtime_error("EGL has no surfaceless platform");
    display_ = library_.function<EGLDisplay(EGLenum, void*, const EGLAttrib*)>("eglGetPlatformDisplay")(
        EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY ||
        !library_.function<EGLBoolean(EGLDisplay, EGLint*, EGLint*)>("eglInitialize")(display_, nullptr, nullptr))
      throw std::runtime_error("EGL cannot be initialised without a display");
    library_.function<EGLBoolean(EGLenum)>("eglBindAPI")(EGL_OPENGL_API);
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    library_.function<EGLBoolean(EGLDisplay, const EGLint*, EGLConfig*, EGLint, EGLint*)>("eglChooseConfig")(
        display_, wanted, &config, 1, &count);
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = library_.function<EGLContext(EGLDisplay, EGLConfig, EGLContext, const EGLint*)>("eglCreateContext")(
        display_, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT) throw std::runtime_error("EGL makes no OpenGL 3.3 context");
  }

  ~EglContext() override {
    doneCurrent();
    library_.function<EGLBoolean(EGLDisplay, EGLContext)>("eglDestroyContext")(display_, context_);
  }

  std::string_view name() const override { return "EGL"; }
  bool isCurrent() const override { return currentContext_() == context_; }

  void makeCurrent() override {
    if (isCurrent()) return;
    if (!makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw std::runtime_error("EGL's context cannot be made current");
  }

  void doneCurrent() override {
    if (isCurrent()) makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

 private:
  DynamicLibrary library_{"libEGL.so.1"};
  EGLContext (*currentContext_)() = library_.function<EGLContext()>("eglGetCurrentContext");
  EGLBoolean (*makeCurrent_)(EGLDisplay, EGLSurface, EGLSurface, EGLContext) =
      library_.function<EGLBoolean(EGLDisplay, EGLSurface, EGLSurface, EGLContext)>("eglMakeCurrent");
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> makeEglContext() { return std::make_unique<EglContext>(); }

std::unique_ptr<OffscreenContext> makeOffscreenContext() {
  try {
    return makeMesaContext();
  } catch (const std::runtime_error& mesaError) {
    try {
      return makeEglContext();
    } catch (const std::runtime_error& eglError) {
      throw std::runtime_error(std::string("no way to draw without a display: ") + mesaError.what() + "; " +
                               eglError.what());
    }
  }
}

}  // namespace pliant::render
