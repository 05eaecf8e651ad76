#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <array>
#include <vector>

#include "ui/render/points.hpp"

namespace pliant::render {

/// A surface that is shaded smoothly and seen from both sides, coloured by a number a triangle.
class SheetPrimitive {
 public:
  SheetPrimitive();
  vtkActor* actor() { return actor_; }
  void setTopology(const std::vector<std::array<int, 3>>& triangles);
  /// Columns that the triangles name; moved along the normals by `offset` [m].
  void setPoints(const Points& points, double offset = 0);
  /// One number a triangle, coloured by `table` (null: the actor's colour).
  void setField(const Eigen::VectorXd* field, vtkLookupTable* table);

 private:
  std::vector<std::array<int, 3>> triangles_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
};

}  // namespace pliant::render
