#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>

#include <array>
#include <vector>

#include "ui/render/points.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

void setColor(vtkActor* actor, const Color& color);

/// Stripes on the screen instead of filled surfaces, `period` pixels apart, with holes between them.
void setHatched(vtkActor* actor, double period);

/// Triangles over all nodes of a model.
class SurfacePrimitive {
 public:
  SurfacePrimitive();
  vtkActor* actor() { return actor_; }
  void setTopology(const std::vector<std::array<int, 3>>& triangles);
  void setPoints(vtkPoints* points) { data_->SetPoints(points); }
  /// One number a triangle, coloured by `table` (null: the actor's colour).
  void setField(const Eigen::VectorXd* field, vtkLookupTable* table);

 protected:
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
};

/// Lines of a width in pixels, without lighting: between nodes, or along curves of their own.
class LinePrimitive {
 public:
  explicit LinePrimitive(double width);
  vtkActor* actor() { return actor_; }
  void setTopology(const std::vector<std::array<int, 2>>& segments);
  void setPoints(vtkPoints* points) { data_->SetPoints(points); }
  /// Closed curves; `dash` > 0: only every other piece of about this length [m] is drawn.
  void setClosedCurves(const std::vector<Points>& curves, double dash);
  void setPixelRatio(double ratio);

 private:
  double width_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
};

/// The same small body at some nodes, each with its size.
class MarkerPrimitive {
 public:
  enum class Shape { sphere, cube };
  explicit MarkerPrimitive(Shape shape);
  vtkActor* actor() { return actor_; }
  /// `radii` [m], one a node.
  void setNodes(std::vector<int> nodes, const std::vector<double>& radii);
  void setPoints(const Points& points);

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkGlyph3DMapper> mapper_;
  vtkNew<vtkActor> actor_;
  std::vector<int> nodes_;
};

/// Dots of a diameter in pixels at some nodes.
class DotPrimitive {
 public:
  explicit DotPrimitive(double diameter);
  vtkActor* actor() { return actor_; }
  void setNodes(std::vector<int> nodes) { nodes_ = std::move(nodes); }
  void setPoints(const Points& points);
  void setPixelRatio(double ratio);

 private:
  double diameter_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  std::vector<int> nodes_;
};

}  // namespace pliant::render
