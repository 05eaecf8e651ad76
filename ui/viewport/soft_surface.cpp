#include "ui/viewport/soft_surface.hpp"

#include <QOpenGLContext>
#include <QPainter>
#include <QWidget>

#include "ui/render/offscreen_target.hpp"

namespace pliant::viewport {
namespace {

class SoftWidget final : public QWidget {
 public:
  explicit SoftWidget(QWidget* parent) : QWidget(parent) { setAttribute(Qt::WA_OpaquePaintEvent); }
  std::function<void(QPainter&)> onPaint;
  std::function<void()> onResized;

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    if (onPaint) onPaint(painter);
  }
  void resizeEvent(QResizeEvent*) override {
    if (onResized) onResized();
  }
};

class SoftSurface final : public RenderSurface {
 public:
  explicit SoftSurface(QWidget* parent) : widget_(new SoftWidget(parent)) {
    widget_->onPaint = [this](QPainter& painter) { painter.drawImage(QPointF(0, 0), upToDateImage()); };
    widget_->onResized = [this] { updateSize(); };
  }

  QWidget* widget() override { return widget_.get(); }
  vtkRenderWindow* window() override { return target_.window(); }
  void requestRender() override {
    upToDate_ = false;
    widget_->update();
  }
  QImage grabImage() override { return upToDateImage().copy(); }
  QString name() const override { return QStringLiteral("software"); }
  bool drawsInSoftware() const override { return true; }

 private:
  void updateSize() {
    const QSize largest(render::OffscreenTarget::largestSide, render::OffscreenTarget::largestSide);
    const double ratio = widget_->devicePixelRatioF();
    const QSize size = (QSizeF(widget_->size()) * ratio).toSize().expandedTo(QSize(1, 1)).boundedTo(largest);
    if (size == size_ && ratio == ratio_) return;
    size_ = size;
    ratio_ = ratio;
    upToDate_ = false;
    target_.setSize(size.width(), size.height());
    if (onResize) onResize(ratio);
  }

  /// Shares its pixels with `pixels_`.
  QImage upToDateImage() {
    updateSize();
    if (!upToDate_) {
      // Qt's context, if one is current on this thread, would be in the way of Mesa's.
      if (QOpenGLContext* other = QOpenGLContext::currentContext()) other->doneCurrent();
      target_.render(pixels_, render::ChannelOrder::argbWord);
      upToDate_ = true;
    }
    // The format of the backing store: painting is copying.
    QImage image(pixels_.pixels.data(), pixels_.width, pixels_.height, QImage::Format_RGB32);
    image.setDevicePixelRatio(ratio_);
    return image;
  }

  render::OffscreenTarget target_;
  render::Image pixels_;
  std::unique_ptr<SoftWidget> widget_;
  QSize size_;
  double ratio_ = 0;
  bool upToDate_ = false;
};

}  // namespace

std::unique_ptr<RenderSurface> makeSoftSurface(QWidget* parent) { return std::make_unique<SoftSurface>(parent); }

}  // namespace pliant::viewport
