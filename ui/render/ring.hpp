#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <Eigen/Core>
#include <array>
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
  // Side by side, since what is drawn over the window lies at one depth: halo, line, halo.
  std::array<vtkNew<vtkActor2D>, 3> bands_;
};

}  // namespace pliant::render
