#include "ui/viewport/gl_surface.hpp"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>

#include "ui/render/opengl_window.hpp"

namespace pliant::viewport {
namespace {

/// A VTK window whose context is that of a QOpenGLWidget.
class WidgetWindow final : public render::OpenGLWindow {
 public:
  static WidgetWindow* New();
  vtkTypeMacro(WidgetWindow, render::OpenGLWindow)

      void setWidget(QOpenGLWidget* widget) {
    widget_ = widget;
  }
  bool IsCurrent() override {
    return widget_ && widget_->context() && QOpenGLContext::currentContext() == widget_->context();
  }
  /// Not if it is current already: that would bind Qt's framebuffer in the middle of a rendering.
  void MakeCurrent() override {
    if (widget_ && !IsCurrent()) widget_->makeCurrent();
  }

 private:
  QOpenGLWidget* widget_ = nullptr;
};
vtkStandardNewMacro(WidgetWindow)

    class GlWidget final : public QOpenGLWidget {
 public:
  explicit GlWidget(QWidget* parent) : QOpenGLWidget(parent) {
    setFormat(glSurfaceFormat());
    window_->setWidget(this);
    window_->SetReadyForRendering(false);
  }

  ~GlWidget() override {
    // The base class's destructor destroys the context when the members are gone already.
    disconnect(contextConnection_);
    releaseGraphics();
    window_->setWidget(nullptr);
  }

  WidgetWindow* window() { return window_; }
  bool drawsInSoftware() const { return drawsInSoftware_; }
  std::function<void(double)> onResized;

  void updateSize() {
    const double ratio = devicePixelRatioF();
    const QSize size = (QSizeF(this->size()) * ratio).toSize().expandedTo(QSize(1, 1));
    if (size == size_ && ratio == ratio_) return;
    size_ = size;
    ratio_ = ratio;
    window_->SetSize(size.width(), size.height());
    if (onResized) onResized(ratio);
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    updateSize();
    QOpenGLWidget::resizeEvent(event);
  }

  /// Called again with another context when the widget moves to another top-level window.
  void initializeGL() override {
    disconnect(contextConnection_);
    contextConnection_ = connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] { releaseGraphics(); });
    const auto* name = reinterpret_cast<const char*>(context()->functions()->glGetString(GL_RENDERER));
    const QByteArray renderer(name ? name : "");
    drawsInSoftware_ = renderer.contains("llvmpipe") || renderer.contains("softpipe") || renderer.contains("SWR");
    window_->OpenGLInitContext();
    window_->SetMapped(1);
    window_->SetReadyForRendering(true);
  }

  void paintGL() override {
    updateSize();
    vtkOpenGLState* state = window_->GetState();
    state->Reset();
    state->Push();
    state->vtkglDepthFunc(GL_LEQUAL);
    window_->Render();
    QOpenGLFunctions* gl = context()->functions();
    gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, defaultFramebufferObject());
    window_->BlitDisplayFramebuffer();
    state->Pop();
    // What VTK leaves in the alpha channel would be holes in a grabbed picture.
    gl->glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
    gl->glDisable(GL_SCISSOR_TEST);
    gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
    gl->glClearColor(0, 0, 0, 1);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }

 private:
  void releaseGraphics() {
    if (!window_->GetReadyForRendering()) return;
    makeCurrent();
    window_->Finalize();
    window_->SetReadyForRendering(false);
    doneCurrent();
  }

  vtkNew<WidgetWindow> window_;
  QMetaObject::Connection contextConnection_;
  QSize size_;
  double ratio_ = 0;
  bool drawsInSoftware_ = false;
};

class GlSurface final : public RenderSurface {
 public:
  explicit GlSurface(QWidget* parent) : widget_(new GlWidget(parent)) {
    widget_->onResized = [this](double ratio) {
      if (onResize) onResize(ratio);
    };
  }

  QWidget* widget() override { return widget_.get(); }
  vtkRenderWindow* window() override { return widget_->window(); }
  void requestRender() override { widget_->update(); }
  QImage grabImage() override { return widget_->grabFramebuffer().convertToFormat(QImage::Format_RGB32); }
  QString name() const override { return QStringLiteral("OpenGL"); }
  bool drawsInSoftware() const override { return widget_->drawsInSoftware(); }

 private:
  std::unique_ptr<GlWidget> widget_;
};

}  // namespace

QSurfaceFormat glSurfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  return format;
}

std::unique_ptr<RenderSurface> makeGlSurface(QWidget* parent) { return std::make_unique<GlSurface>(parent); }

}  // namespace pliant::viewport
