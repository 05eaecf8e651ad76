#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <array>

#include "ui/render/primitives.hpp"

class vtkTextActor;

namespace pliant::render {

/// The three axes in the bottom left corner, turning with the camera.
class Gizmo {
 public:
  Gizmo();
  ~Gizmo();
  vtkRenderer* renderer() { return renderer_; }
  void setTheme(const Palette& palette);
  void setPixelRatio(double ratio);
  void setVisible(bool visible);
  /// Takes the camera's direction and the window's size in pixels.
  void follow(vtkCamera* camera, int windowWidth, int windowHeight);

 private:
  double ratio_ = 1;
  bool visible_ = true;
  vtkNew<vtkRenderer> renderer_;
  std::array<vtkNew<vtkActor>, 3> axes_;
  std::array<vtkNew<vtkTextActor>, 3> letters_;
};

}  // namespace pliant::render
