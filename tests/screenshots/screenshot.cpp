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

/// How far a pixel lies outside of what stands around the same place in another picture.
int distanceToSurroundings(QRgb pixel, const QImage& other, int x, int y) {
  int low[3] = {255, 255, 255}, high[3] = {0, 0, 0};
  for (int v = std::max(0, y - 1); v <= std::min(other.height() - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(other.width() - 1, x + 1); ++u) {
      const QRgb near = other.pixel(u, v);
      const int channels[3] = {qRed(near), qGreen(near), qBlue(near)};
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], channels[c]);
        high[c] = std::max(high[c], channels[c]);
      }
    }
  const int channels[3] = {qRed(pixel), qGreen(pixel), qBlue(pixel)};
  int distance = 0;
  for (int c = 0; c < 3; ++c) distance = std::max({distance, low[c] - channels[c], channels[c] - high[c]});
  return distance;
}

int difference(const QImage& actual, const QImage& baseline, int x, int y, Sharpness sharpness) {
  const QRgb here = actual.pixel(x, y), there = baseline.pixel(x, y);
  const int plain = difference(here, there);
  if (sharpness == Sharpness::exact || plain <= tolerance) return plain;
  // Both ways: what is gone counts as much as what has come.
  return std::max(distanceToSurroundings(here, baseline, x, y), distanceToSurroundings(there, actual, x, y));
}

}  // namespace

QString compareWithBaseline(const QImage& picture, const QString& name, int allowedPixels, Sharpness sharpness) {
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
      const int here = difference(actual, baseline, x, y, sharpness);
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
