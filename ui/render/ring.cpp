#include "ui/render/ring.hpp"

#include <vtkDiskSource.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

namespace pliant::render {
namespace {

constexpr std::array<double, 4> radii{6.5, 8.0, 10.0, 11.5};  // of the bands' edges, device-independent pixels

}  // namespace

Ring::Ring() { setPixelRatio(1.0); }

void Ring::addTo(vtkRenderer* renderer) {
  for (auto& band : bands_) renderer->AddActor2D(band);
}

void Ring::setColors(const Color& line, const Color& halo) {
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const Color& color = i == 1 ? line : halo;
    bands_[i]->GetProperty()->SetColor(color[0], color[1], color[2]);
  }
}

void Ring::setPixelRatio(double ratio) {
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    vtkNew<vtkDiskSource> disk;
    disk->SetInnerRadius(radii[i] * ratio);
    disk->SetOuterRadius(radii[i + 1] * ratio);
    disk->SetCircumferentialResolution(48);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputConnection(disk->GetOutputPort());
    bands_[i]->SetMapper(mapper);
  }
}

void Ring::setPlace(const std::optional<Eigen::Vector2d>& pixel) {
  for (auto& band : bands_) {
    band->SetVisibility(pixel.has_value());
    if (pixel) band->SetPosition(pixel->x(), pixel->y());
  }
}

}  // namespace pliant::render
