#pragma once

#include "ui/render/view.hpp"

namespace pliant::render {

/// A view of something that was recorded: it shows one frame of many.
class FrameView : public View {
 public:
  /// Shows the frame with this number, if there is one.
  virtual void setFrame(int frame) = 0;
  /// -1: none.
  virtual int frame() const = 0;
};

}  // namespace pliant::render
