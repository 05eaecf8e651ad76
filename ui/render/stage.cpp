#include "ui/render/stage.hpp"

#include <SMP/Common/vtkSMPToolsAPI.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkCullerCollection.h>
#include <vtkLight.h>
#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>

#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr double captionMargin = 14;  // device-independent pixels
constexpr int fineSamples = 8;

}  // namespace

Stage::Stage() {
  // What is drawn is small: waking VTK's pool of threads costs more than it saves, and the solver wants the cores.
  vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
  renderer_->AutomaticLightCreationOff();
  renderer_->GetCullers()->RemoveAllItems();  // nothing is worth the pass over all bounds
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(-0.45, 0.65, 1.0);
  light->SetFocalPoint(0, 0, 0);
  renderer_->AddLight(light);
  legend_.addTo(renderer_);
  renderer_->AddActor2D(caption_);
  renderer_->AddActor2D(notice_);
  notice_->VisibilityOff();
  observer_ = renderer_->AddObserver(vtkCommand::StartEvent, this, &Stage::layOut);
}

Stage::~Stage() {
  attach(nullptr);
  renderer_->RemoveObserver(observer_);
}

const Palette& Stage::colors() const { return palette(theme_); }

void Stage::attach(vtkRenderWindow* window) {
  if (window_ == window) return;
  if (window_) {
    window_->RemoveRenderer(renderer_);
    window_->RemoveRenderer(gizmo_.renderer());
  }
  window_ = window;
  if (window) {
    window->SetNumberOfLayers(2);
    window->AddRenderer(renderer_);
    window->AddRenderer(gizmo_.renderer());
    setPixelRatio(ratio_);
    setFineQuality(fine_);
  }
  if (onAttach) onAttach();
}

void Stage::layOut() {
  const int* size = renderer_->GetSize();
  legend_.layOut(size[0], size[1]);
  const int* whole = window_->GetSize();
  gizmo_.follow(renderer_->GetActiveCamera(), whole[0], whole[1]);
  if (onLayOut) onLayOut();
  const double margin = captionMargin * ratio_;
  caption_->SetPosition(margin, size[1] - margin);
  double height[2] = {0, 0};
  if (!captionText_.empty()) caption_->GetSize(renderer_, height);
  notice_->SetPosition(margin, size[1] - margin - (height[1] > 0 ? height[1] + 8 * ratio_ : 0));
}

void Stage::setCaption(const std::string& text) {
  captionText_ = text;
  caption_->SetInput(text.c_str());
  caption_->SetVisibility(!text.empty() && !frameless_);
}

void Stage::setNotice(const std::string& text, const Color& color) {
  notice_->SetInput(text.c_str());
  notice_->SetVisibility(!text.empty());
  setTextStyle(notice_->GetTextProperty(), 13, color);
}

void Stage::setTheme(Theme theme) {
  theme_ = theme;
  const Palette& colors = palette(theme);
  renderer_->SetBackground(colors.background.data());
  legend_.setTheme(colors);
  gizmo_.setTheme(colors);
  for (vtkTextActor* text : {caption_.Get(), notice_.Get()}) {
    setTextStyle(text->GetTextProperty(), 13, colors.text);
    text->GetTextProperty()->SetVerticalJustificationToTop();
    text->GetTextProperty()->SetLineSpacing(1.2);
  }
  if (onTheme) onTheme();
}

void Stage::setPixelRatio(double ratio) {
  ratio_ = ratio;
  if (window_) window_->SetDPI(static_cast<int>(72 * ratio + 0.5));
  legend_.setPixelRatio(ratio);
  gizmo_.setPixelRatio(ratio);
  if (onPixelRatio) onPixelRatio();
  setLegendVisible(legendVisible_);
}

void Stage::setFineQuality(bool fine) {
  fine_ = fine;
  if (window_) window_->SetMultiSamples(fine ? fineSamples : 0);
}

void Stage::setFrameless(bool frameless) {
  frameless_ = frameless;
  gizmo_.setVisible(!frameless && gizmoVisible_);
  caption_->SetVisibility(!frameless && !captionText_.empty());
  setLegendVisible(legendVisible_);
}

void Stage::setGizmoVisible(bool visible) {
  gizmoVisible_ = visible;
  gizmo_.setVisible(visible && !frameless_);
}

void Stage::setFieldVisible(bool visible) {
  fieldVisible_ = visible;
  if (onField) onField();
}

void Stage::setLegendVisible(bool visible) {
  legendVisible_ = visible;
  const bool shown = visible && !frameless_;
  legend_.setVisible(shown);
  camera_.setRightMargin(shown ? Legend::width * ratio_ : 0);
}

}  // namespace pliant::render
