#pragma once

#include <vtkUnsignedCharArray.h>

#include <array>

#include "ui/render/boundary_geometry.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

/// A closed surface with a colour at each point, which can be seen through: its far side is drawn first, then its near
/// side, so that nothing has to be sorted. What is to be seen through it has to be added before it.
class TranslucentSurface {
 public:
  TranslucentSurface();
  /// In the order in which they have to be added.
  std::array<vtkActor*, 2> actors() { return {sides_[0], sides_[1]}; }
  void setSurface(const Points& points, const TriangleList& triangles, const std::vector<Color>& colors);
  void setOpacity(double opacity);
  void setVisible(bool visible);

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkUnsignedCharArray> colors_;
  std::array<vtkNew<vtkPolyDataMapper>, 2> mappers_;
  std::array<vtkNew<vtkActor>, 2> sides_;  ///< far, near
};

/// A flat filled outline with a line around it.
class ShadowFigure {
 public:
  void addTo(vtkRenderer* renderer);
  /// An outline of the shadow along `axis`, put onto the wall there.
  void setOutline(const Eigen::Matrix2Xd& outline, int axis, double wall);
  void setColors(const Color& fill, const Color& line);
  /// Without: the line alone.
  void setFilled(bool filled);
  void setVisible(bool visible);
  void setPixelRatio(double ratio) { line_.setPixelRatio(ratio); }

 private:
  SurfacePrimitive fill_;
  LinePrimitive line_{1.4};
  bool filled_ = true;
};

}  // namespace pliant::render
