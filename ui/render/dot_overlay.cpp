#include "ui/render/dot_overlay.hpp"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <cmath>
#include <numbers>

namespace pliant::render {
namespace {

constexpr int corners = 20;
constexpr double discRadius = 3.6, rimWidth = 1.2;  // device-independent pixels

/// Rings from radius `inner` to `outer` around all places; side by side with others, since all that is drawn over the
/// window lies at one depth.
void setRings(vtkPolyData* data, const Eigen::Matrix2Xd& pixels, double inner, double outer) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& pixel : pixels.colwise()) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      for (const double radius : {inner, outer})
        points->InsertNextPoint(pixel.x() + radius * std::cos(angle), pixel.y() + radius * std::sin(angle), 0);
    }
    for (int i = 0; i < corners; ++i) {
      const vtkIdType from = first + 2 * i, to = first + 2 * ((i + 1) % corners);
      cells->InsertNextCell({from, from + 1, to + 1, to});
    }
  }
  data->SetPoints(points);
  data->SetPolys(cells);
}

}  // namespace

DotOverlay::DotOverlay() {
  for (const auto& [data, actor] :
       {std::pair(discs_.Get(), discActor_.Get()), std::pair(rims_.Get(), rimActor_.Get())}) {
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    actor->SetMapper(mapper);
  }
  setPlaces(Eigen::Matrix2Xd(2, 0));
}

void DotOverlay::addTo(vtkRenderer* renderer) {
  renderer->AddActor2D(discActor_);
  renderer->AddActor2D(rimActor_);
}

void DotOverlay::setColors(const Color& disc, const Color& rim) {
  discActor_->GetProperty()->SetColor(disc[0], disc[1], disc[2]);
  rimActor_->GetProperty()->SetColor(rim[0], rim[1], rim[2]);
}

void DotOverlay::setVisible(bool visible) {
  discActor_->SetVisibility(visible);
  rimActor_->SetVisibility(visible);
}

void DotOverlay::setPlaces(const Eigen::Matrix2Xd& pixels) {
  setRings(discs_, pixels, 0, discRadius * ratio_);
  setRings(rims_, pixels, discRadius * ratio_, (discRadius + rimWidth) * ratio_);
}

}  // namespace pliant::render
