#pragma once

#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkUnsignedCharArray.h>

#include "core/geometry/surface_mesh.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

/// Rigid copies of one smooth surface, each in its place and colour, drawn all at once: hundreds of elements cost
/// little more than one.
class BodyGlyphs {
 public:
  BodyGlyphs();
  vtkActor* actor() { return actor_; }
  /// In its own coordinates.
  void setShape(const geometry::SurfaceMesh& mesh);
  /// One column and one rotation a copy.
  void setPoses(const Points& positions, const std::vector<Eigen::Matrix3d>& rotations);
  /// One a copy.
  void setColors(const std::vector<Color>& colors);

 private:
  vtkNew<vtkPoints> places_;
  vtkNew<vtkDoubleArray> turns_;
  vtkNew<vtkUnsignedCharArray> colors_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkGlyph3DMapper> mapper_;
  vtkNew<vtkActor> actor_;
};

}  // namespace pliant::render
