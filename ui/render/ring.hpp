#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <Eigen/Core>
#include <optional>

#include "ui/render/theme.hpp"

namespace pliant::render {

/// A ring around a place of the window, over everything else.
class Ring {
 public:
  Ring();
  void addTo(vtkRenderer* renderer);
  void setColors(const Color& line, const Color& halo);
  void setPixelRatio(double ratio);
  /// In pixels from the bottom left; none: hidden.
  void setPlace(const std::optional<Eigen::Vector2d>& pixel);

 private:
  vtkNew<vtkActor2D> halo_;
  vtkNew<vtkActor2D> line_;
};

}  // namespace pliant::render
