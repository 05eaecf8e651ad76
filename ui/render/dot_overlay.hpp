#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <Eigen/Core>

#include "ui/render/theme.hpp"

namespace pliant::render {

/// Small discs at places of the window, over everything else, each with a rim that sets it off.
class DotOverlay {
 public:
  DotOverlay();
  void addTo(vtkRenderer* renderer);
  void setColors(const Color& disc, const Color& rim);
  void setPixelRatio(double ratio) { ratio_ = ratio; }
  void setVisible(bool visible);
  /// In pixels from the bottom left, one column a disc.
  void setPlaces(const Eigen::Matrix2Xd& pixels);

 private:
  double ratio_ = 1;
  vtkNew<vtkPolyData> discs_, rims_;
  vtkNew<vtkActor2D> discActor_, rimActor_;
};

}  // namespace pliant::render
