#pragma once

#include "ui/render/camera_control.hpp"
#include "ui/render/dot_overlay.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// What is marked over a large piece: clamped and loaded nodes, origins of elements beside it, and one triangle.
class MacroMarks {
 public:
  void addTo(vtkRenderer* renderer);
  void setPixelRatio(double ratio);
  void setVisible(bool visible);
  void setColors(const Palette& colors);
  /// Where the camera sees them; `ringed`: the middle of the triangle.
  void place(const CameraControl& camera, const Points& clamped, const Points& loaded, const Points& elements,
             const std::optional<Eigen::Vector3d>& ringed);

 private:
  DotOverlay clamps_, loads_, origins_;
  Ring ring_;
};

}  // namespace pliant::render
