#pragma once

#include <Qt>

namespace pliant::viewport {

/// Gets the viewport's mouse before the viewport does. Places are physical pixels from the top left; what answers true
/// is done with, and the view stays where it is.
class MouseTool {
 public:
  virtual ~MouseTool() = default;
  virtual bool press(double x, double y, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) = 0;
  /// With a button down that was taken by `press`.
  virtual void drag(double x, double y) = 0;
  virtual void release() = 0;
  /// Without a button. Whether something can be taken there.
  virtual bool hover(double x, double y) = 0;
  /// Escape. False: there was nothing to end.
  virtual bool escape() = 0;
};

}  // namespace pliant::viewport
