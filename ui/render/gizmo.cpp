#include "ui/render/gizmo.hpp"

#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkCullerCollection.h>
#include <vtkProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr double size = 88;  // device-independent pixels
constexpr std::array<Color, 3> axisColors{Color{0.835, 0.369, 0.0}, Color{0.0, 0.62, 0.451}, Color{0.0, 0.447, 0.698}};

}  // namespace

Gizmo::Gizmo() {
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
  renderer_->GetCullers()->RemoveAllItems();
  renderer_->GetActiveCamera()->ParallelProjectionOn();
  vtkNew<vtkArrowSource> arrow;
  arrow->SetShaftRadius(0.045);
  arrow->SetTipRadius(0.13);
  arrow->SetTipLength(0.3);
  arrow->SetShaftResolution(16);
  arrow->SetTipResolution(24);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(arrow->GetOutputPort());
  for (int axis = 0; axis < 3; ++axis) {
    axes_[axis]->SetMapper(mapper);
    if (axis == 1) axes_[axis]->RotateZ(90);
    if (axis == 2) axes_[axis]->RotateY(-90);
    setColor(axes_[axis], axisColors[axis]);
    axes_[axis]->GetProperty()->SetAmbient(0.4);
    axes_[axis]->GetProperty()->SetDiffuse(0.6);
    renderer_->AddActor(axes_[axis]);
    letters_[axis]->SetInput(std::string(1, "xyz"[axis]).c_str());
    // In the overlay: text among the solids is blended, in a pass that costs a fifth of a frame in software.
    vtkCoordinate* place = letters_[axis]->GetPositionCoordinate();
    place->SetCoordinateSystemToWorld();
    place->SetValue(axis == 0 ? 1.3 : 0, axis == 1 ? 1.3 : 0, axis == 2 ? 1.3 : 0);
    renderer_->AddActor2D(letters_[axis]);
  }
}

Gizmo::~Gizmo() = default;

void Gizmo::setTheme(const Palette& palette) {
  for (auto& letter : letters_) {
    setTextStyle(letter->GetTextProperty(), 12, palette.text);
    letter->GetTextProperty()->SetJustificationToCentered();
    letter->GetTextProperty()->SetVerticalJustificationToCentered();
  }
}

void Gizmo::setPixelRatio(double ratio) { ratio_ = ratio; }

void Gizmo::setVisible(bool visible) {
  visible_ = visible;
  for (auto& axis : axes_) axis->SetVisibility(visible);
}

void Gizmo::follow(vtkCamera* camera, int windowWidth, int windowHeight) {
  if (windowWidth <= 0 || windowHeight <= 0) return;
  renderer_->SetViewport(0, 0, std::min(1.0, size * ratio_ / windowWidth), std::min(1.0, size * ratio_ / windowHeight));
  vtkCamera* own = renderer_->GetActiveCamera();
  double direction[3];
  camera->GetDirectionOfProjection(direction);
  own->SetFocalPoint(0, 0, 0);
  own->SetPosition(-5 * direction[0], -5 * direction[1], -5 * direction[2]);
  own->SetViewUp(camera->GetViewUp());
  own->SetParallelScale(1.65);
  own->SetClippingRange(1, 10);
  // An axis seen from its end has no room for its letter.
  for (int axis = 0; axis < 3; ++axis) letters_[axis]->SetVisibility(visible_ && std::abs(direction[axis]) < 0.95);
}

}  // namespace pliant::render
