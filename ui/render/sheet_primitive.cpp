#include "ui/render/sheet_primitive.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace pliant::render {

SheetPrimitive::SheetPrimitive() {
  normals_->SetNumberOfComponents(3);
  normals_->SetName("normals");
  data_->SetPoints(points_);
  data_->GetPointData()->SetNormals(normals_);
  actor_->GetProperty()->SetInterpolationToPhong();
}

void SheetPrimitive::setTopology(const std::vector<std::array<int, 3>>& triangles) {
  triangles_ = triangles;
  SurfacePrimitive::setTopology(triangles);
}

void SheetPrimitive::setPoints(const Points& points, double offset) {
  Points normals = Points::Zero(3, points.cols());
  for (const auto& [a, b, c] : triangles_) {
    const Eigen::Vector3d normal = (points.col(b) - points.col(a)).cross(points.col(c) - points.col(a));
    for (const int corner : {a, b, c}) normals.col(corner) += normal;  // weighted by area
  }
  normals.colwise().normalize();
  points_->SetNumberOfPoints(points.cols());
  normals_->SetNumberOfTuples(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d place = points.col(i) + offset * normals.col(i);
    points_->SetPoint(i, place.data());
    normals_->SetTuple(i, normals.col(i).data());
  }
  points_->Modified();
  normals_->Modified();
  data_->Modified();
}

}  // namespace pliant::render
