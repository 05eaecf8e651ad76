#include <QTest>

#include "tests/ui/render/hanging_sheet.hpp"
#include "tests/ui/render/pixels.hpp"
#include "ui/render/drape_figure.hpp"

namespace pliant::render {

namespace {

constexpr int width = 600, height = 500;

/// How far the curve of a limit reaches from its middle.
struct Reach {
  int left = width, right = 0, top = height, bottom = 0;
  int across() const { return right - left; }
  int along() const { return bottom - top; }
};

Reach reachOfCurve(const Image& image, int from, int to) {
  const Color blue = palette(Theme::light).mass;
  Reach reach;
  for (int y = 0; y < image.height; ++y)
    for (int x = from; x < to; ++x) {
      const std::uint8_t* pixel = &image.pixels[4 * static_cast<std::size_t>(y * image.width + x)];
      bool same = true;
      for (std::size_t i = 0; i < 3; ++i) same = same && std::abs(pixel[i] - 255 * blue[i]) < 24;
      if (!same) continue;
      reach.left = std::min(reach.left, x);
      reach.right = std::max(reach.right, x);
      reach.top = std::min(reach.top, y);
      reach.bottom = std::max(reach.bottom, y);
    }
  return reach;
}

}  // namespace

/// Limits above, drapes below.
class TestDrapeFigure : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void columnsStandSideBySide() {
    QCOMPARE(drapeGrid(0).columns, 1);
    QCOMPARE(drapeGrid(3).columns, 3);
    QCOMPARE(drapeGrid(3).rows, 1);
    QCOMPARE(drapeGrid(6).columns, 4);
    QCOMPARE(drapeGrid(6).rows, 2);
    const HangingSheet sheet;
    const Drape drape{"sheet", sheet.problem, sheet.frames.back()};
    const Image three = drawDrapes({drape, drape, drape}, width, height, 0.6, Theme::light);
    QCOMPARE(three.width, width);
    QCOMPARE(three.height, height);
    // The same in each column, but for edges that are smoothed.
    int different = 0;
    for (int y = 0; y < height - 24; ++y)
      for (int x = 0; x < width / 3; ++x) {
        const std::uint8_t* first = &three.pixels[4 * static_cast<std::size_t>(y * width + x)];
        different +=
            !std::equal(first, first + 3, first + 4 * (width / 3), [](int a, int b) { return std::abs(a - b) < 48; });
      }
    QVERIFY2(different < width * height / 300, qPrintable(QString::number(different)));
    QVERIFY(drawDrapes({drape, drape, drape}, width, height, 0.6, Theme::light).pixels == three.pixels);
    QVERIFY(drawDrapes({drape, drape, drape}, width, height, 0.6, Theme::dark).pixels != three.pixels);
    // Anything of a cloth is below, a title alone has none.
    const Image none = drawDrapes({{"sheet", nullptr, nullptr}}, width, height, 0.6, Theme::light);
    const Image one = drawDrapes({drape}, width, height, 0.6, Theme::light);
    QVERIFY(one.pixels != none.pixels);
    QCOMPARE(reachOfCurve(none, 0, width).across(), -width);
  }

  void theCurveIsThatOfTheLimit() {
    const HangingSheet sheet;
    auto wide = std::make_shared<cloth::ClothProblem>(*sheet.problem);
    wide->sheet.limits = {cloth::OrthotropicLimit{1.3, 1.1, 0}};
    const Image image = drawDrapes({{"round", sheet.problem, sheet.frames.back()}, {"wide", wide, sheet.frames.back()}},
                                   width, height, 0.6, Theme::light);
    const Reach round = reachOfCurve(image, 0, width / 2), oblong = reachOfCurve(image, width / 2, width);
    QVERIFY(round.across() > 80);
    QVERIFY(std::abs(round.across() - round.along()) <= 2);
    // Both reach equally far at most, since each has its own scale; across, the limit is three times as far from rest.
    QVERIFY(std::abs(oblong.across() - round.across()) <= 3);
    QVERIFY(oblong.along() < 0.7 * oblong.across());
    QVERIFY(round.bottom < height / 2 && oblong.bottom < height / 2);
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestDrapeFigure)
#include "test_drape_figure.moc"
