#include "ui/shell/thumbnail.hpp"

#include "core/base/error.hpp"
#include "ui/document/document.hpp"
#include "ui/plots/shape_image.hpp"

namespace pliant::shell {

QImage thumbnail(const QString& sceneFile, const QSize& size, double pixelRatio, const QPalette& palette) {
  try {
    const auto model = document::loadScene(sceneFile).model;
    return plots::shapeImage(*model, model->restPositions, size, pixelRatio, palette);
  } catch (const base::InputError&) {
    QImage image(size * pixelRatio, QImage::Format_ARGB32_Premultiplied);
    image.setDevicePixelRatio(pixelRatio);
    image.fill(Qt::transparent);
    return image;
  }
}

}  // namespace pliant::shell
