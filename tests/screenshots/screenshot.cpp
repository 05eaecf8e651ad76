#include "tests/screenshots/screenshot.hpp"

#include <QDir>
#include <algorithm>
#include <cstdlib>

namespace pliant::screenshots {
namespace {

constexpr int tolerance = 2;     // of 255
constexpr int enlargement = 20;  // of differences in the picture of them

int difference(QRgb a, QRgb b) {
  return std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)), std::abs(qBlue(a) - qBlue(b))});
}

}  // namespace

QString compareWithBaseline(const QImage& picture, const QString& name, int allowedPixels) {
  const QImage actual = picture.convertToFormat(QImage::Format_RGB32);
  const QString baselineFile = QStringLiteral(PLIANT_SOURCE_DIR "/tests/screenshots/baselines/") + name + ".png";
  if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS"))
    return actual.save(baselineFile) ? QString() : baselineFile + " cannot be written";

  const QString kept = QStringLiteral(PLIANT_BINARY_DIR "/screenshots/") + name;
  const auto fail = [&](const QString& sentence) {
    QDir().mkpath(QStringLiteral(PLIANT_BINARY_DIR "/screenshots"));
    actual.save(kept + ".actual.png");
    return sentence + "; see " + kept + ".actual.png";
  };
  const QImage baseline = QImage(baselineFile).convertToFormat(QImage::Format_RGB32);
  if (baseline.isNull()) return fail("there is no baseline " + baselineFile);
  if (baseline.size() != actual.size())
    return fail(QString("the picture is %1 x %2 pixels, its baseline %3 x %4")
                    .arg(actual.width())
                    .arg(actual.height())
                    .arg(baseline.width())
                    .arg(baseline.height()));
  QImage differences(actual.size(), QImage::Format_Grayscale8);
  int count = 0, largest = 0;
  for (int y = 0; y < actual.height(); ++y)
    for (int x = 0; x < actual.width(); ++x) {
      const int here = difference(actual.pixel(x, y), baseline.pixel(x, y));
      differences.scanLine(y)[x] = static_cast<uchar>(std::min(255, enlargement * here));
      count += here > tolerance;
      largest = std::max(largest, here);
    }
  if (count <= allowedPixels) return {};
  QDir().mkpath(QStringLiteral(PLIANT_BINARY_DIR "/screenshots"));
  differences.save(kept + ".difference.png");
  return fail(QString("%1 pixels differ from the baseline (%2 may), by up to %3 of 255")
                  .arg(count)
                  .arg(allowedPixels)
                  .arg(largest));
}

}  // namespace pliant::screenshots
