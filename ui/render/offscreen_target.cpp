#include "ui/render/offscreen_target.hpp"

#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include "core/base/error.hpp"
#include "ui/render/opengl_window.hpp"

namespace pliant::render {
namespace {

class OffscreenWindow final : public OpenGLWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, OpenGLWindow)

      void setContext(OffscreenContext* context) {
    context_ = context;
  }
  bool IsCurrent() override { return context_ && context_->isCurrent(); }
  void MakeCurrent() override {
    if (context_) context_->makeCurrent();
  }

 private:
  OffscreenContext* context_ = nullptr;
};
vtkStandardNewMacro(OffscreenWindow);

}  // namespace

struct OffscreenTarget::Parts {
  std::unique_ptr<OffscreenContext> context;
  vtkNew<OffscreenWindow> window;
};

OffscreenTarget::OffscreenTarget(std::unique_ptr<OffscreenContext> context) : parts_(std::make_unique<Parts>()) {
  parts_->context = std::move(context);
  parts_->window->setContext(parts_->context.get());
  parts_->context->makeCurrent();
  parts_->window->OpenGLInitContext();
}

OffscreenTarget::~OffscreenTarget() {
  parts_->context->makeCurrent();
  parts_->window->Finalize();
  parts_->window->setContext(nullptr);
}

vtkRenderWindow* OffscreenTarget::window() const { return parts_->window; }

std::string_view OffscreenTarget::contextName() const { return parts_->context->name(); }

void OffscreenTarget::setSize(int width, int height) {
  if (width < 1 || height < 1 || width > largestSide || height > largestSide)
    throw base::InputError("", "the size of the picture is " + std::to_string(width) + "x" + std::to_string(height) +
                                   "; each side has to lie between 1 and " + std::to_string(largestSide) + " pixels");
  parts_->window->SetSize(width, height);
}

void OffscreenTarget::render(Image& image, ChannelOrder order) {
  parts_->context->makeCurrent();
  parts_->window->Render();
  parts_->window->readPixels(image, order);
}

}  // namespace pliant::render
