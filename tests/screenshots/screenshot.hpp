#pragma once

#include <QImage>
#include <QString>

namespace pliant::screenshots {

/// How exactly a picture has to agree with its baseline.
enum class Sharpness {
  exact,   ///< every pixel to 2 of 255: processors round differently
  smooth,  ///< lines and letters may lie up to a pixel off, where fonts or anti-aliasing differ a little
};

/// Compares a picture with tests/screenshots/baselines/`name`.png: all but `allowedPixels` pixels have to
/// agree. Returns an empty text, or one sentence that says what
/// differs; then `name`.actual.png and `name`.difference.png (differences enlarged) stand in the folder "screenshots"
/// of the build tree. With PLIANT_RECORD_SCREENSHOTS=1 in the environment the picture becomes the baseline instead.
QString compareWithBaseline(const QImage& picture, const QString& name, int allowedPixels,
                            Sharpness sharpness = Sharpness::exact);

}  // namespace pliant::screenshots
