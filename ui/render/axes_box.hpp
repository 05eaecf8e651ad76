#pragma once

#include <vtkTextActor.h>

#include <array>
#include <string>
#include <vector>

#include "ui/render/camera_control.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

/// Three walls of a box behind a figure, with grid lines at round numbers, and the numbers and names of its axes where
/// they cover nothing. Walls and numbers change sides as the camera moves.
class AxesBox {
 public:
  void addTo(vtkRenderer* renderer);
  /// `names` such as "E_x [%]"; numbers are coordinates times `factor`. The box reaches from `low` to `high`, widened
  /// to leave room.
  void setRange(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const std::array<std::string, 3>& names,
                double factor);
  void setVisible(bool visible);
  void setTheme(const Palette& palette);
  void setPixelRatio(double ratio);
  /// Called when rendering begins.
  void layOut(const CameraControl& camera);

  const Eigen::Vector3d& low() const { return low_; }
  const Eigen::Vector3d& high() const { return high_; }
  /// Whether the wall across `axis` that is shown stands at its high end.
  bool wallIsHigh(int axis) const { return wallIsHigh_[static_cast<std::size_t>(axis)]; }
  double wall(int axis) const { return wallIsHigh(axis) ? high_[axis] : low_[axis]; }

 private:
  static constexpr int mostTicks = 9;
  void placeWalls();
  void placeLabels(int axis, const CameraControl& camera);

  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(-1), high_ = Eigen::Vector3d::Constant(1);
  std::array<std::vector<double>, 3> ticks_;
  std::array<bool, 3> wallIsHigh_{};
  bool visible_ = true;
  double ratio_ = 1;
  LinePrimitive grid_{1.0}, frame_{1.2};
  std::array<std::array<vtkNew<vtkTextActor>, mostTicks>, 3> numbers_;
  std::array<vtkNew<vtkTextActor>, 3> names_;
};

}  // namespace pliant::render
