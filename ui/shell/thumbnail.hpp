#pragma once

#include <QImage>
#include <QPalette>
#include <QString>

namespace pliant::shell {

/// A small picture of a scene's rest shape, seen from above at an angle; transparent around it, and empty if the file
/// is no scene. May be called from any thread.
QImage thumbnail(const QString& sceneFile, const QSize& size, double pixelRatio, const QPalette& palette);

}  // namespace pliant::shell
