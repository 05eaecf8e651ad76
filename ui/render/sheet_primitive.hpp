#pragma once

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <array>
#include <vector>

#include "ui/render/primitives.hpp"

namespace pliant::render {

/// A surface that is shaded smoothly and seen from both sides.
class SheetPrimitive final : public SurfacePrimitive {
 public:
  SheetPrimitive();
  void setTopology(const std::vector<std::array<int, 3>>& triangles);
  /// Columns that the triangles name; moved along the normals by `offset` [m].
  void setPoints(const Points& points, double offset = 0);

 private:
  std::vector<std::array<int, 3>> triangles_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normals_;
};

}  // namespace pliant::render
