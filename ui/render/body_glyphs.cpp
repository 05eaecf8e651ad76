#include "ui/render/body_glyphs.hpp"

#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <cmath>

namespace pliant::render {

namespace {
constexpr const char* turnArray = "turns";
constexpr const char* colorArray = "colors";
}  // namespace

BodyGlyphs::BodyGlyphs() {
  turns_->SetNumberOfComponents(4);
  turns_->SetName(turnArray);
  colors_->SetNumberOfComponents(3);
  colors_->SetName(colorArray);
  data_->SetPoints(places_);
  data_->GetPointData()->AddArray(turns_);
  data_->GetPointData()->AddArray(colors_);
  mapper_->SetInputData(data_);
  mapper_->SetOrientationArray(turnArray);
  mapper_->SetOrientationModeToQuaternion();
  mapper_->ScalingOff();
  mapper_->SetScalarModeToUsePointFieldData();
  mapper_->SelectColorArray(colorArray);
  mapper_->SetColorModeToDirectScalars();
  actor_->SetMapper(mapper_);
  vtkProperty* property = actor_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(0.35);
  property->SetDiffuse(0.6);
  property->SetSpecular(0.25);
  property->SetSpecularPower(25);
}

void BodyGlyphs::setShape(const geometry::SurfaceMesh& mesh) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh.points.cols());
  Points directions = Points::Zero(3, mesh.points.cols());
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : mesh.triangles) {
    cells->InsertNextCell({a, b, c});
    const Eigen::Vector3d normal =
        (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a));
    for (const int corner : {a, b, c}) directions.col(corner) += normal;  // weighted by area
  }
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    points->InsertNextPoint(mesh.points.col(i).data());
    const Eigen::Vector3d normal = directions.col(i).normalized();
    normals->SetTuple(i, normal.data());
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(cells);
  shape->GetPointData()->SetNormals(normals);
  mapper_->SetSourceData(shape);
}

void BodyGlyphs::setPoses(const Points& positions, const std::vector<Eigen::Matrix3d>& rotations) {
  places_->SetNumberOfPoints(positions.cols());
  turns_->SetNumberOfTuples(positions.cols());
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    places_->SetPoint(i, positions.col(i).data());
    const Eigen::Quaterniond turn(rotations[static_cast<std::size_t>(i)]);
    turns_->SetTuple4(i, turn.w(), turn.x(), turn.y(), turn.z());
  }
  places_->Modified();
  turns_->Modified();
  data_->Modified();
}

void BodyGlyphs::setColors(const std::vector<Color>& colors) {
  colors_->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i)
    for (int channel = 0; channel < 3; ++channel)
      colors_->SetComponent(
          static_cast<vtkIdType>(i), channel, std::round(255 * colors[i][static_cast<std::size_t>(channel)]));
  colors_->Modified();
  data_->Modified();
}

}  // namespace pliant::render
