#include "ui/render/thread_safe_text.hpp"

#include <vtkMathTextFreeTypeTextRenderer.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkVersion.h>

#include <mutex>

namespace pliant::render {
namespace {

class LockedTextRenderer final : public vtkMathTextFreeTypeTextRenderer {
 public:
  static LockedTextRenderer* New();
  vtkTypeMacro(LockedTextRenderer, vtkMathTextFreeTypeTextRenderer)

      protected : bool GetBoundingBoxInternal(vtkTextProperty* style, const vtkStdString& text, int box[4], int dpi,
                                              int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::GetBoundingBoxInternal(style, text, box, dpi, backend);
  }
  bool GetMetricsInternal(vtkTextProperty* style, const vtkStdString& text, Metrics& metrics, int dpi,
                          int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::GetMetricsInternal(style, text, metrics, dpi, backend);
  }
  bool RenderStringInternal(vtkTextProperty* style, const vtkStdString& text, vtkImageData* image, int size[2], int dpi,
                            int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::RenderStringInternal(style, text, image, size, dpi, backend);
  }
  int GetConstrainedFontSizeInternal(const vtkStdString& text, vtkTextProperty* style, int width, int height, int dpi,
                                     int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::GetConstrainedFontSizeInternal(text, style, width, height, dpi, backend);
  }
  bool StringToPathInternal(vtkTextProperty* style, const vtkStdString& text, vtkPath* path, int dpi,
                            int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::StringToPathInternal(style, text, path, dpi, backend);
  }

  using vtkMathTextFreeTypeTextRenderer::GetBoundingBoxInternal;
  using vtkMathTextFreeTypeTextRenderer::GetConstrainedFontSizeInternal;
  using vtkMathTextFreeTypeTextRenderer::GetMetricsInternal;
  using vtkMathTextFreeTypeTextRenderer::RenderStringInternal;
  using vtkMathTextFreeTypeTextRenderer::StringToPathInternal;

 private:
  std::mutex mutex_;
};
vtkStandardNewMacro(LockedTextRenderer);

class LockedTextFactory final : public vtkObjectFactory {
 public:
  static LockedTextFactory* New();
  vtkTypeMacro(LockedTextFactory, vtkObjectFactory)

      LockedTextFactory() {
    RegisterOverride("vtkTextRenderer", "LockedTextRenderer", "text that threads take turns to draw", 1,
                     [] { return static_cast<vtkObject*>(LockedTextRenderer::New()); });
  }
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "text that threads take turns to draw"; }
};
vtkStandardNewMacro(LockedTextFactory);

}  // namespace

void makeTextThreadSafe() {
  static const bool done = [] {
    vtkObjectFactory::SetAllEnableFlags(0, "vtkTextRenderer");
    const vtkNew<LockedTextFactory> factory;
    vtkObjectFactory::RegisterFactory(factory);
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace pliant::render
