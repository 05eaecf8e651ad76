#include "ui/render/primitives.hpp"

#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkDoubleArray.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pliant::render {
namespace {

constexpr const char* radiusArray = "radius";

void makeFlat(vtkActor* actor) {
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetInterpolationToFlat();
}

/// Spares each frame the work that our data make needless: an update of the pipeline, which has one stage, and a pass
/// over all points for a range that keeps digits which coordinates in single precision have lost anyway.
void makeLean(vtkPolyDataMapper* mapper) {
  mapper->StaticOn();
  if (auto* openGL = vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
    openGL->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
}

/// Copies the chosen columns.
void setPositions(vtkPoints* points, const Points& positions, const std::vector<int>& nodes) {
  points->SetNumberOfPoints(static_cast<vtkIdType>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), positions.col(nodes[i]).data());
  points->Modified();
}

}  // namespace

void setColor(vtkActor* actor, const Color& color) { actor->GetProperty()->SetColor(color[0], color[1], color[2]); }

void setHatched(vtkActor* actor, double period) {
  // Holes rather than blending: VTK blends in a pass of its own that costs more than everything else in software.
  vtkShaderProperty* shader = actor->GetShaderProperty();
  shader->ClearAllFragmentShaderReplacements();
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                       "//VTK::Light::Impl\n  if (mod(gl_FragCoord.x + gl_FragCoord.y, " +
                                           std::to_string(period) + ") > " + std::to_string(0.3 * period) +
                                           ") discard;\n",
                                       false);
  actor->GetProperty()->LightingOff();
}

SurfacePrimitive::SurfacePrimitive() {
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  mapper_->SetScalarModeToUseCellData();
  mapper_->UseLookupTableScalarRangeOn();
  makeLean(mapper_);
  actor_->SetMapper(mapper_);
  vtkProperty* property = actor_->GetProperty();
  property->SetInterpolationToFlat();
  property->SetAmbient(0.55);
  property->SetDiffuse(0.5);
}

void SurfacePrimitive::setTopology(const std::vector<std::array<int, 3>>& triangles) {
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(triangles.size()), 3 * static_cast<vtkIdType>(triangles.size()));
  for (const auto& [a, b, c] : triangles) cells->InsertNextCell({a, b, c});
  data_->SetPolys(cells);
  data_->GetCellData()->SetScalars(nullptr);
}

void SurfacePrimitive::setField(const Eigen::VectorXd* field, vtkLookupTable* table) {
  mapper_->SetScalarVisibility(field != nullptr);
  if (!field) return;
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfValues(field->size());
  std::copy(field->begin(), field->end(), values->GetPointer(0));
  data_->GetCellData()->SetScalars(values);
  mapper_->SetLookupTable(table);
}

LinePrimitive::LinePrimitive(double width) : width_(width) {
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  makeLean(mapper_);
  actor_->SetMapper(mapper_);
  makeFlat(actor_);
  setPixelRatio(1.0);
}

void LinePrimitive::setTopology(const std::vector<std::array<int, 2>>& segments) {
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : segments) cells->InsertNextCell({a, b});
  data_->SetLines(cells);
}

void LinePrimitive::setClosedCurves(const std::vector<Points>& curves, double dash) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  std::vector<vtkIdType> line;  // being drawn
  const auto endLine = [&] {
    if (!line.empty()) cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
    line.clear();
  };
  for (const Points& curve : curves) {
    const Eigen::Index count = curve.cols();
    double length = 0;
    for (Eigen::Index i = 0; i < count; ++i) length += (curve.col((i + 1) % count) - curve.col(i)).norm();
    // A whole, even number of pieces, so that the pattern closes; a short curve still shows a few.
    const double pieces = dash > 0 ? 2 * std::max(4.0, std::round(0.5 * length / dash)) : 1;
    const double piece = length / pieces;
    double travelled = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3d from = curve.col(i), to = curve.col((i + 1) % count);
      const double step = (to - from).norm();
      const auto addPoint = [&](double part) {
        line.push_back(points->InsertNextPoint(Eigen::Vector3d(from + part * (to - from)).data()));
      };
      for (double begin = 0; step > 0 && begin < 1;) {
        // Up to the end of this edge, or to where the dash or gap ends on it.
        const double place = std::floor((travelled + begin * step) / piece + 1e-9);
        const double end = dash > 0 ? std::min(1.0, ((place + 1) * piece - travelled) / step) : 1.0;
        if (dash > 0 && std::fmod(place, 2.0) != 0) {
          endLine();
        } else {
          if (line.empty()) addPoint(begin);
          addPoint(end);
        }
        begin = end;
      }
      travelled += step;
    }
    endLine();
  }
  data_->SetPoints(points);
  data_->SetLines(cells);
}

void LinePrimitive::setPixelRatio(double ratio) {
  actor_->GetProperty()->SetLineWidth(static_cast<float>(width_ * ratio));
}

MarkerPrimitive::MarkerPrimitive(Shape shape) {
  data_->SetPoints(points_);
  if (shape == Shape::sphere) {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1.0);
    sphere->SetThetaResolution(16);
    sphere->SetPhiResolution(12);
    sphere->Update();
    mapper_->SetSourceData(sphere->GetOutput());
  } else {
    vtkNew<vtkCubeSource> cube;
    cube->SetXLength(2.0);
    cube->SetYLength(2.0);
    cube->SetZLength(2.0);
    cube->Update();
    mapper_->SetSourceData(cube->GetOutput());
  }
  mapper_->SetInputData(data_);
  mapper_->SetScaleModeToScaleByMagnitude();
  mapper_->SetScaleArray(radiusArray);
  mapper_->ScalarVisibilityOff();
  mapper_->OrientOff();
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->SetAmbient(0.3);
  actor_->GetProperty()->SetDiffuse(0.7);
  actor_->GetProperty()->SetSpecular(0.25);
  actor_->GetProperty()->SetSpecularPower(30);
}

void MarkerPrimitive::setNodes(std::vector<int> nodes, const std::vector<double>& radii) {
  nodes_ = std::move(nodes);
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName(radiusArray);
  sizes->SetNumberOfValues(static_cast<vtkIdType>(radii.size()));
  std::copy(radii.begin(), radii.end(), sizes->GetPointer(0));
  data_->GetPointData()->AddArray(sizes);
}

void MarkerPrimitive::setPoints(const Points& points) {
  setPositions(points_, points, nodes_);
  data_->Modified();
}

DotPrimitive::DotPrimitive(double diameter) : diameter_(diameter) {
  data_->SetPoints(points_);
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  makeLean(mapper_);
  actor_->SetMapper(mapper_);
  makeFlat(actor_);
  actor_->GetProperty()->RenderPointsAsSpheresOn();
  setPixelRatio(1.0);
}

void DotPrimitive::setPoints(const Points& points) {
  setPositions(points_, points, nodes_);
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < points_->GetNumberOfPoints(); ++i) cells->InsertNextCell({i});
  data_->SetVerts(cells);
}

void DotPrimitive::setPixelRatio(double ratio) {
  actor_->GetProperty()->SetPointSize(static_cast<float>(diameter_ * ratio));
}

}  // namespace pliant::render
