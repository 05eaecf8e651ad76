#include "ui/render/boundary_surface_figure.hpp"

#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <cmath>

namespace pliant::render {

TranslucentSurface::TranslucentSurface() {
  data_->SetPoints(points_);
  colors_->SetNumberOfComponents(3);
  for (std::size_t side = 0; side < 2; ++side) {
    mappers_[side]->SetInputData(data_);
    sides_[side]->SetMapper(mappers_[side]);
    vtkProperty* property = sides_[side]->GetProperty();
    property->SetInterpolationToPhong();
    property->SetAmbient(0.55);
    property->SetDiffuse(0.5);
    property->SetFrontfaceCulling(side == 0);
    property->SetBackfaceCulling(side == 1);
    // Drawn in order like what cannot be seen through: VTK's own pass for transparency costs more than all else.
    sides_[side]->ForceOpaqueOn();
  }
}

void TranslucentSurface::setSurface(const Points& points, const TriangleList& triangles,
                                    const std::vector<Color>& colors) {
  Points normals = Points::Zero(3, points.cols());
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : triangles) {
    cells->InsertNextCell({a, b, c});
    const Eigen::Vector3d normal = (points.col(b) - points.col(a)).cross(points.col(c) - points.col(a));
    for (const int corner : {a, b, c}) normals.col(corner) += normal;  // weighted by area
  }
  vtkNew<vtkFloatArray> directions;
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(points.cols());
  points_->SetNumberOfPoints(points.cols());
  colors_->SetNumberOfTuples(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points_->SetPoint(i, points.col(i).data());
    const Eigen::Vector3d normal = normals.col(i).normalized();
    directions->SetTuple(i, normal.data());
    for (int channel = 0; channel < 3; ++channel)
      colors_->SetComponent(
          i, channel, std::round(255 * colors[static_cast<std::size_t>(i)][static_cast<std::size_t>(channel)]));
  }
  data_->SetPolys(cells);
  data_->GetPointData()->SetNormals(directions);
  data_->GetPointData()->SetScalars(colors_);
  points_->Modified();
  colors_->Modified();
  data_->Modified();
}

void TranslucentSurface::setOpacity(double opacity) {
  sides_[1]->GetProperty()->SetOpacity(opacity);
  // The far side is not seen at all through what is opaque, and less than the near side otherwise.
  sides_[0]->GetProperty()->SetOpacity(opacity < 1 ? 0.8 * opacity : 1);
}

void TranslucentSurface::setVisible(bool visible) {
  for (auto& side : sides_) side->SetVisibility(visible);
}

void ShadowFigure::addTo(vtkRenderer* renderer) {
  renderer->AddActor(fill_.actor());
  renderer->AddActor(line_.actor());
  fill_.actor()->GetProperty()->LightingOff();
}

void ShadowFigure::setOutline(const Eigen::Matrix2Xd& outline, int axis, double wall) {
  const auto count = static_cast<int>(outline.cols());
  Points places(3, count + 1);
  places.row(axis).setConstant(wall);
  for (int i = 0; i < 2; ++i) {
    places.row((axis + 1 + i) % 3).head(count) = outline.row(i);
    places((axis + 1 + i) % 3, count) = count > 0 ? outline.row(i).mean() : 0;
  }
  TriangleList fan;
  for (int i = 0; i < count; ++i) fan.push_back({count, i, (i + 1) % count});
  vtkNew<vtkPoints> points;
  for (const auto& place : places.colwise()) points->InsertNextPoint(place.data());
  fill_.setPoints(points);
  fill_.setTopology(fan);
  line_.setClosedCurves({places.leftCols(count)}, 0);
}

void ShadowFigure::setColors(const Color& fill, const Color& line) {
  setColor(fill_.actor(), fill);
  setColor(line_.actor(), line);
}

void ShadowFigure::setFilled(bool filled) { filled_ = filled; }

void ShadowFigure::setVisible(bool visible) {
  fill_.actor()->SetVisibility(visible && filled_);
  line_.actor()->SetVisibility(visible);
}

}  // namespace pliant::render
