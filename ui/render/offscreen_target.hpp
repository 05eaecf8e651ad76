#pragma once

#include <memory>
#include <string_view>

#include "ui/render/image.hpp"
#include "ui/render/offscreen_context.hpp"

class vtkRenderWindow;

namespace pliant::render {

/// A VTK window in memory.
class OffscreenTarget {
 public:
  static constexpr int largestSide = 8192;  ///< pixels; what a framebuffer of every driver holds

  /// Throws std::runtime_error as makeOffscreenContext() does.
  explicit OffscreenTarget(std::unique_ptr<OffscreenContext> context = makeOffscreenContext());
  ~OffscreenTarget();

  vtkRenderWindow* window() const;
  std::string_view contextName() const;
  /// Throws base::InputError if the size is not positive or too large.
  void setSize(int width, int height);
  /// Draws what is attached to window() and returns the pixels; `image` is reused from one call to the next.
  void render(Image& image, ChannelOrder order = ChannelOrder::rgbaBytes);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
