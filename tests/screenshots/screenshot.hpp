#pragma once

#include <QImage>
#include <QString>

namespace pliant::screenshots {

/// Compares a picture with tests/screenshots/baselines/`name`.png: all but `allowedPixels` pixels have to agree to 2 of
/// 255 in every channel, since processors round differently. Returns an empty text, or one sentence that says what
/// differs; then `name`.actual.png and `name`.difference.png (differences enlarged) stand in the folder "screenshots"
/// of the build tree. With PLIANT_RECORD_SCREENSHOTS=1 in the environment the picture becomes the baseline instead.
QString compareWithBaseline(const QImage& picture, const QString& name, int allowedPixels);

}  // namespace pliant::screenshots
