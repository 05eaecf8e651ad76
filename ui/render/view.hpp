#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "ui/render/theme.hpp"

class vtkRenderWindow;

namespace pliant::render {

/// Where the camera looks from.
enum class AxisView { front, back, right, left, top, bottom, isometric };

/// Where a camera stands [m].
struct CameraPose {
  Eigen::Vector3d position, focus, up;
};

class Stage;

/// What can be shown in a window: a figure with camera, scalar bar, gizmo and labels around it. Belongs to the thread
/// that owns its window.
class View {
 public:
  virtual ~View();
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// Shows itself in `window` from now on (null: in none). The window must outlive that.
  void attach(vtkRenderWindow* window);
  /// The small label in the top left corner; lines separated by '\n'; empty: none.
  void setCaption(const std::string& text);
  std::string caption() const;
  void setTheme(Theme theme);
  /// Colours surfaces by their field, with the scalar bar (on at first).
  void setFieldVisible(bool visible);
  bool fieldVisible() const;
  /// Without scalar bar, gizmo and labels, to stand in a figure.
  void setFrameless(bool frameless);
  /// Pixels per device-independent pixel: scales text, lines and markers.
  void setPixelRatio(double ratio);
  /// Smooth edges (8 samples a pixel): cheap on a graphics processor, but six times the cost of a frame in software,
  /// where it is for stills. On at first.
  void setFineQuality(bool fine);

  /// Looks at everything the motion reaches.
  void fit();
  void setAxisView(AxisView view);
  CameraPose cameraPose() const;
  void setCameraPose(const CameraPose& pose);
  /// Turns about the middle of the view; fractions of the window's height (a whole height: 180°), x to the right, y
  /// down.
  void orbit(double dx, double dy);
  /// Moves the scene with the pointer; physical pixels.
  void pan(double dx, double dy);
  /// Enlarges by `factor`, keeping what is under the pixel (x, y) (from the top left) in place.
  void zoom(double factor, double x, double y);
  /// The node nearest to the pixel (x, y) (from the top left) within `radius` pixels, as drawn at present.
  virtual std::optional<int> pickNode(double x, double y, double radius) const = 0;

 protected:
  View();
  Stage& stage() { return *stage_; }
  const Stage& stage() const { return *stage_; }

 private:
  std::unique_ptr<Stage> stage_;
};

}  // namespace pliant::render
