#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ui/render/primitives.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// Moves the camera of a renderer. Pixels count from the top left of the renderer's window
/// unless another corner is said.
class CameraControl {
 public:
  explicit CameraControl(vtkRenderer* renderer);

  /// All points that may be seen; the camera is fitted to them and nothing of them is clipped.
  void setReach(Points reach);
  /// Leaves this many pixels free on the right when fitting.
  void setRightMargin(double pixels) { rightMargin_ = pixels; }
  /// The same at the top, for a caption of several lines.
  void setTopMargin(double pixels) { topMargin_ = pixels; }

  /// Which axis points up: z, or y where gravity pulls against it. Counts from the next axis view on.
  void setUpAxis(bool isY) { upIsY_ = isY; }
  void setAxisView(AxisView view);
  void fit();
  CameraPose pose() const;
  void setPose(const CameraPose& pose);
  void orbit(double dx, double dy);
  void pan(double dx, double dy);
  /// A place right of the window is one in a second one beside it, as wide, with the same camera.
  void zoom(double factor, double x, double y);
  /// Where a point is seen, from the bottom left of the window; none if it is behind the camera.
  std::optional<Eigen::Vector2d> pixelOf(const Eigen::Vector3d& point) const;
  /// What is seen at the pixel (x, y) in the plane through `point` that faces the camera; none if it is behind it.
  std::optional<Eigen::Vector3d> pointBeside(const Eigen::Vector3d& point, double x, double y) const;
  /// Whether each point is in the window, or a distance beside it [m].
  std::vector<char> inView(const Points& points, double slack) const;
  /// Of a pixel in the plane that is looked at [m].
  double pixelSize() const;
  std::optional<int> nearestPoint(const Points& points, double x, double y, double radius) const;

 private:
  Eigen::Matrix4d projection() const;
  void updateClipping();

  vtkRenderer* renderer_;
  Points reach_;
  double rightMargin_ = 0;
  double topMargin_ = 0;
  bool upIsY_ = false;
};

}  // namespace pliant::render
