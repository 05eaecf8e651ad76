#include <QTest>

#include "core/cloth/limit_envelope.hpp"
#include "tests/ui/render/hanging_sheet.hpp"
#include "tests/ui/render/pixels.hpp"
#include "ui/render/offscreen.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

namespace {

/// A view of the sheet in memory.
struct SheetPicture {
  HangingSheet sheet;
  OffscreenTarget target;
  ClothView view;

  SheetPicture() {
    target.setSize(480, 320);
    view.attach(target.window());
    view.setProblem(sheet.problem);
    view.setFrames(sheet.frames);
    view.setAxisView(AxisView::isometric);
    view.setFineQuality(false);
  }
  ~SheetPicture() { view.attach(nullptr); }

  Image draw() {
    Image image;
    target.render(image);
    return image;
  }
};

/// The pink of driven nodes, lit.
bool isPin(int red, int green, int blue) { return red > green + 40 && blue > green + 15; }

/// Bright yellow-green: the upper end of viridis, as it is lit, and nothing else.
bool isAtLimit(int red, int green, int blue) { return red > blue + 70 && green > blue + 70; }

}  // namespace

class TestClothView : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void coloursTellHowNearTheLimitIs();
  void pinsAreSeenAsLongAsTheyHold();
  void framesMayGrow();
  void everythingThatIsReachedIsInTheFrame();
  void gravitySaysWhatIsUp();
  void whatIsPickedIsANode();
  void largestStretchIsFoundOfEveryKind();
};

void TestClothView::coloursTellHowNearTheLimitIs() {
  SheetPicture picture;
  const auto yellow = [&](int frame) {
    picture.view.setFrame(frame);
    const Image image = picture.draw();
    // The scalar bar keeps its yellow: only what lies left of it counts.
    Image cut = image;
    const int right = image.width - 112;
    for (int y = 0; y < image.height; ++y)
      for (int x = right; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) cut.pixels[4 * (static_cast<std::size_t>(y) * image.width + x) + c] = 0;
    return findBlob(cut, isAtLimit).pixels;
  };
  QCOMPARE(yellow(0), 0);  // at rest nothing is near its limit
  QVERIFY(yellow(10) > 200);
  picture.view.setFieldVisible(false);
  QCOMPARE(yellow(10), 0);
}

void TestClothView::pinsAreSeenAsLongAsTheyHold() {
  SheetPicture picture;
  picture.view.setFieldVisible(false);
  picture.view.setFrame(7);
  QVERIFY(findBlob(picture.draw(), isPin).pixels > 10);
  picture.view.setFrame(8);  // released at 0.75 s
  QCOMPARE(findBlob(picture.draw(), isPin).pixels, 0);
}

void TestClothView::framesMayGrow() {
  SheetPicture picture;
  const auto all = picture.sheet.frames;
  picture.view.setFrames({all.begin(), all.begin() + 4});
  QVERIFY(picture.view.frame() <= 3);
  picture.view.setFrame(3);
  const Image early = picture.draw();
  picture.view.setFrame(9);  // there is none yet
  QCOMPARE(picture.view.frame(), 3);
  picture.view.setFrames({all.begin(), all.begin() + 10});
  QCOMPARE(picture.view.frame(), 3);
  picture.view.setFrame(9);
  QVERIFY(picture.draw().pixels != early.pixels);
  // What is drawn depends on the frame, not on the way to it.
  picture.view.setFrames(all);
  picture.view.setFrame(2);
  const Image once = picture.draw();
  picture.view.setFrame(6);
  picture.draw();
  picture.view.setFrame(2);
  QVERIFY(picture.draw().pixels == once.pixels);
}

void TestClothView::everythingThatIsReachedIsInTheFrame() {
  const HangingSheet sheet;
  PictureOptions options;
  options.width = 480;
  options.height = 320;
  for (std::size_t count = 1; count <= sheet.frames.size(); count += 5) {
    const Image image = renderToImage(sheet.problem, {sheet.frames.begin(), sheet.frames.begin() + count}, options);
    const Blob blob = findBlob(image, differsFrom(palette(Theme::light).background));
    QVERIFY(blob.pixels > 3000);
    QVERIFY(blob.top > 2 && blob.bottom < image.height - 2 && blob.left > 2);
  }
}

void TestClothView::gravitySaysWhatIsUp() {
  const HangingSheet sheet;
  const auto pinHeight = [&](const Eigen::Vector3d& gravity) {
    auto model = std::make_shared<mechanics::Model>(*sheet.problem->model);
    model->gravity = gravity;
    auto problem = std::make_shared<cloth::ClothProblem>(*sheet.problem);
    problem->model = model;
    problem->pins = {{"far", {16 * 17 + 8}, {}, {}}};  // in the middle of the edge at the largest y
    problem->bodies.clear();
    PictureOptions options;
    options.width = 480;
    options.height = 320;
    options.view = AxisView::front;
    return findBlob(renderToImage(problem, {}, options), isPin).y;
  };
  // The sheet lies in the plane z = 0: from the front it is a line, or, where y is up, a square with that edge on top.
  QVERIFY(std::abs(pinHeight({0, 0, -9.81}) - 160) < 12);
  QVERIFY(pinHeight({0, -9.81, 0}) < 60);
}

void TestClothView::whatIsPickedIsANode() {
  SheetPicture picture;
  picture.view.setFrame(0);
  picture.draw();
  int found = 0;
  for (int x = 20; x < 360; x += 10)
    for (int y = 20; y < 300; y += 10)
      if (const auto node = picture.view.pickNode(x, y, 8)) {
        QVERIFY(*node >= 0 && *node < picture.sheet.problem->model->nodeCount());
        ++found;
      }
  QVERIFY(found > 20);
  QVERIFY(!picture.view.pickNode(2, 2, 3));
}

void TestClothView::largestStretchIsFoundOfEveryKind() {
  QCOMPARE(cloth::largestStretch(cloth::IsotropicLimit{1.1}), 1.1);
  QCOMPARE(cloth::largestStretch(cloth::OrthotropicLimit{1.1, 1.3, 0.2}), 1.3);
  QCOMPARE(cloth::largestStretch(cloth::LimitCurve({{0, 1.1}, {1, 1.25}, {2, 1.05}})), 1.25);
}

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestClothView)
#include "test_cloth_view.moc"
