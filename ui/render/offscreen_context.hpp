#pragma once

#include <memory>
#include <string_view>

namespace pliant::render {

/// An OpenGL context (3.3 core) that needs no display. Used by one thread.
class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  virtual std::string_view name() const = 0;
  virtual bool isCurrent() const = 0;
  /// Nothing to do if it is current already. Throws std::runtime_error if it cannot be made current, such as when a
  /// context of somebody else (Qt's, say) is current on this thread.
  virtual void makeCurrent() = 0;
  virtual void doneCurrent() = 0;
};

/// Mesa's software renderer, made a vendor of libglvnd: VTK's and GLEW's ordinary OpenGL calls go to libOSMesa while
/// the context is current. Throws std::runtime_error if a library is missing or libglvnd's interface is another one.
std::unique_ptr<OffscreenContext> makeMesaContext();

/// EGL without a surface. Throws std::runtime_error if it is not to be had.
std::unique_ptr<OffscreenContext> makeEglContext();

/// The first of the two that works; throws std::runtime_error with both reasons.
std::unique_ptr<OffscreenContext> makeOffscreenContext();

}  // namespace pliant::render
