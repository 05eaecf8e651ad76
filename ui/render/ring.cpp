#include "ui/render/ring.hpp"

#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRegularPolygonSource.h>

namespace pliant::render {
namespace {

constexpr double radius = 9, lineWidth = 2, haloWidth = 5;  // device-independent pixels

}  // namespace

Ring::Ring() {
  line_->SetLayerNumber(1);
  setPixelRatio(1.0);
}

void Ring::addTo(vtkRenderer* renderer) {
  renderer->AddActor2D(halo_);
  renderer->AddActor2D(line_);
}

void Ring::setColors(const Color& line, const Color& halo) {
  line_->GetProperty()->SetColor(line[0], line[1], line[2]);
  halo_->GetProperty()->SetColor(halo[0], halo[1], halo[2]);
}

void Ring::setPixelRatio(double ratio) {
  vtkNew<vtkRegularPolygonSource> circle;
  circle->SetNumberOfSides(48);
  circle->SetRadius(radius * ratio);
  circle->GeneratePolygonOff();
  for (auto [actor, width] : {std::pair{halo_.Get(), haloWidth}, std::pair{line_.Get(), lineWidth}}) {
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputConnection(circle->GetOutputPort());
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLineWidth(static_cast<float>(width * ratio));
  }
}

void Ring::setPlace(const std::optional<Eigen::Vector2d>& pixel) {
  for (vtkActor2D* actor : {halo_.Get(), line_.Get()}) {
    actor->SetVisibility(pixel.has_value());
    if (pixel) actor->SetPosition(pixel->x(), pixel->y());
  }
}

}  // namespace pliant::render
