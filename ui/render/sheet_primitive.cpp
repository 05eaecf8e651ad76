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
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  mapper_->SetScalarModeToUseCellData();
  mapper_->UseLookupTableScalarRangeOn();
  mapper_->StaticOn();
  actor_->SetMapper(mapper_);
  vtkProperty* property = actor_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(0.55);
  property->SetDiffuse(0.5);
}

void SheetPrimitive::setTopology(const std::vector<std::array<int, 3>>& triangles) {
  triangles_ = triangles;
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(triangles.size()), 3 * static_cast<vtkIdType>(triangles.size()));
  for (const auto& [a, b, c] : triangles) cells->InsertNextCell({a, b, c});
  data_->SetPolys(cells);
  data_->GetCellData()->SetScalars(nullptr);
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

void SheetPrimitive::setField(const Eigen::VectorXd* field, vtkLookupTable* table) {
  mapper_->SetScalarVisibility(field != nullptr);
  if (!field) return;
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfValues(field->size());
  std::copy(field->begin(), field->end(), values->GetPointer(0));
  data_->GetCellData()->SetScalars(values);
  mapper_->SetLookupTable(table);
}

}  // namespace pliant::render
