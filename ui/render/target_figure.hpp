#pragma once

#include <vtkTextActor.h>

#include <memory>
#include <vector>

#include "ui/render/camera_control.hpp"
#include "ui/render/dot_overlay.hpp"
#include "ui/render/primitives.hpp"
#include "ui/render/target_curve.hpp"

namespace pliant::render {

/// Target paths: dashed, with their names and the points by which they are dragged.
class TargetFigure {
 public:
  void addTo(vtkRenderer* renderer);
  void setTargets(std::vector<TargetCurve> targets);
  const std::vector<TargetCurve>& targets() const { return targets_; }
  Points reach() const;
  void setTheme(const Palette& palette);
  void setPixelRatio(double ratio);
  /// Puts dots and names in their places on the screen.
  void layOut(const CameraControl& camera);

 private:
  void refreshNames();

  std::vector<TargetCurve> targets_;
  LinePrimitive curves_{2.5};
  DotOverlay handles_, active_;
  std::vector<vtkNew<vtkTextActor>> names_;
  vtkRenderer* renderer_ = nullptr;
  Color color_{}, background_{};
  double ratio_ = 1;
};

}  // namespace pliant::render
