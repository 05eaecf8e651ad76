#include "ui/viewport/viewport.hpp"

#include <QApplication>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "tests/ui/render/pixels.hpp"
#include "tests/ui/render/swinging_fork.hpp"

namespace pliant::viewport {
namespace {

using render::Blob;

/// A viewport in a window on the screen, showing a fork with one point mass (at the left tip) at rest.
struct Stage {
  render::SwingingFork fork;
  QWidget window;
  Viewport* viewport = new Viewport(&window);

  Stage() {
    auto model = std::make_shared<mechanics::Model>(*fork.model);
    model->pointMasses = {{"tip", {fork.leftTip}, 0.02, 0, 0.02}};
    window.resize(600, 400);
    viewport->setGeometry(0, 0, 600, 400);
    viewport->setModel(model);
    window.show();
    if (!QTest::qWaitForWindowExposed(&window)) qFatal("the window does not appear");
  }

  double ratio() const { return viewport->devicePixelRatioF(); }

  /// The ball of the point mass, in device-independent pixels.
  Blob ball() const {
    const QImage picture = viewport->grabImage().convertToFormat(QImage::Format_RGBA8888);
    render::Image image{picture.width(), picture.height(), {}};
    image.pixels.assign(picture.constBits(), picture.constBits() + picture.sizeInBytes());
    Blob blob = findBlob(image, render::isMassBlue, static_cast<int>(100 * ratio()));
    blob.x /= ratio();
    blob.y /= ratio();
    return blob;
  }

  void drag(Qt::MouseButton button, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(viewport, button, modifiers, from);
    for (const double part : {0.3, 0.7, 1.0}) {
      const QPointF place = QPointF(from) + part * QPointF(to - from);
      QMouseEvent move(QEvent::MouseMove, place, viewport->mapToGlobal(place), Qt::NoButton, button, modifiers);
      QApplication::sendEvent(viewport, &move);
    }
    QTest::mouseRelease(viewport, button, modifiers, to);
  }

  void wheel(QPointF place, int notches) {
    QWheelEvent event(
        place, viewport->mapToGlobal(place), {}, {0, 120 * notches}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(viewport, &event);
  }
};

bool near(const Blob& a, double x, double y, double tolerance) { return std::hypot(a.x - x, a.y - y) <= tolerance; }

}  // namespace

class TestViewport : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void hasTheScreensResolution();
  void wholeWindowShowsTheSamePicture();
  void dragOrbitsAndFitReturns();
  void middleDragAndShiftDragPan();
  void wheelZoomsTowardsTheCursor();
  void clickPicksTheNode();
  void playsAndPauses();
  void tauIsWrapped();
  void ghostChangesPixelsAndGoes();
  void staleMotionLooksOtherwise();
  void followsThePalette();
  void keysChangeTheView();
  void resizingKeepsTheModelInView();
  void survivesItsEnd();
};

void TestViewport::hasTheScreensResolution() {
  const Stage stage;
  const QImage picture = stage.viewport->grabImage();
  QCOMPARE(picture.size(), (QSizeF(600, 400) * stage.ratio()).toSize());
  QCOMPARE(picture.devicePixelRatio(), stage.ratio());
}

void TestViewport::wholeWindowShowsTheSamePicture() {
  Stage stage;
  const QImage own = stage.viewport->grabImage().convertToFormat(QImage::Format_RGB32);
  const QImage window = stage.window.grab().toImage().convertToFormat(QImage::Format_RGB32);
  QCOMPARE(own.size(), window.size());
  for (int y = 0; y < own.height(); ++y)
    for (int x = 0; x < own.width(); ++x) QCOMPARE(own.pixel(x, y), window.pixel(x, y));
}

void TestViewport::dragOrbitsAndFitReturns() {
  Stage stage;
  const Blob before = stage.ball();
  QVERIFY(before.pixels > 20);
  stage.drag(Qt::LeftButton, {300, 200}, {380, 230});
  const Blob turned = stage.ball();
  QVERIFY(!near(turned, before.x, before.y, 10));
  stage.viewport->setAxisView(render::AxisView::isometric);
  const Blob back = stage.ball();
  QVERIFY(near(back, before.x, before.y, 0.5));
  QCOMPARE(back.pixels, before.pixels);
}

void TestViewport::middleDragAndShiftDragPan() {
  Stage stage;
  stage.viewport->setAxisView(render::AxisView::top);  // the ball lies in the focal plane, where pixels are exact
  const Blob start = stage.ball();
  stage.drag(Qt::MiddleButton, {200, 200}, {170, 240});
  const Blob first = stage.ball();
  QVERIFY(near(first, start.x - 30, start.y + 40, 1.5));
  stage.drag(Qt::LeftButton, {200, 200}, {180, 160}, Qt::ShiftModifier);
  QVERIFY(near(stage.ball(), start.x - 50, start.y, 1.5));
  QTest::mouseDClick(stage.viewport, Qt::LeftButton, {}, {100, 100});
  QVERIFY(near(stage.ball(), start.x, start.y, 0.5));
}

void TestViewport::wheelZoomsTowardsTheCursor() {
  Stage stage;
  stage.viewport->setAxisView(render::AxisView::top);
  const Blob before = stage.ball();
  stage.wheel({before.x, before.y}, 3);
  const Blob after = stage.ball();
  QVERIFY(near(after, before.x, before.y, 1.5));
  QVERIFY(after.pixels > 1.8 * before.pixels);
  stage.wheel({before.x, before.y}, -3);
  const Blob back = stage.ball();
  QVERIFY(near(back, before.x, before.y, 0.5));
}

void TestViewport::clickPicksTheNode() {
  Stage stage;
  QSignalSpy picked(stage.viewport, &Viewport::nodePicked);
  const Blob ball = stage.ball();
  QTest::mouseClick(stage.viewport, Qt::LeftButton, {}, QPointF(ball.x, ball.y).toPoint());
  QCOMPARE(picked.count(), 1);
  QCOMPARE(picked.takeFirst().at(0).toInt(), stage.fork.leftTip);
  QTest::mouseClick(stage.viewport, Qt::LeftButton, {}, QPoint(5, 5));
  QCOMPARE(picked.takeFirst().at(0).toInt(), -1);
  stage.drag(Qt::LeftButton, QPointF(ball.x, ball.y).toPoint(), {300, 200});
  QCOMPARE(picked.count(), 0);

  const QImage without = stage.viewport->grabImage();
  stage.viewport->setSelectedNode(stage.fork.leftTip);
  QCOMPARE(stage.viewport->selectedNode(), std::optional<int>(stage.fork.leftTip));
  QVERIFY(stage.viewport->grabImage() != without);
  stage.viewport->setSelectedNode(100000);
  QVERIFY(!stage.viewport->selectedNode());
}

void TestViewport::playsAndPauses() {
  Stage stage;
  stage.viewport->setMotion(stage.fork.problem, stage.fork.motion(0.03));
  QSignalSpy moved(stage.viewport, &Viewport::tauChanged);
  QSignalSpy playing(stage.viewport, &Viewport::playingChanged);
  const QImage start = stage.viewport->grabImage();
  QTest::keyClick(stage.viewport, Qt::Key_Space);
  QVERIFY(stage.viewport->isPlaying());
  QTRY_VERIFY(moved.count() >= 3);
  stage.viewport->pause();
  QVERIFY(!stage.viewport->isPlaying());
  QCOMPARE(playing.count(), 2);
  QCOMPARE(moved.last().at(0).toDouble(), stage.viewport->tau());
  QVERIFY(stage.viewport->grabImage() != start);
  const double tau = stage.viewport->tau();
  QTest::qWait(60);
  QCOMPARE(stage.viewport->tau(), tau);
  stage.viewport->setTau(0);
  QVERIFY(stage.viewport->grabImage() == start);
}

void TestViewport::tauIsWrapped() {
  Stage stage;
  stage.viewport->setTau(7.0);
  QVERIFY(std::abs(stage.viewport->tau() - (7.0 - 2 * std::numbers::pi)) < 1e-12);
  stage.viewport->setTau(-1.0);
  QVERIFY(std::abs(stage.viewport->tau() - (2 * std::numbers::pi - 1.0)) < 1e-12);
  stage.viewport->setTau(std::numeric_limits<double>::quiet_NaN());
  QVERIFY(std::isfinite(stage.viewport->tau()));
}

void TestViewport::ghostChangesPixelsAndGoes() {
  Stage stage;
  const render::SwingingFork& fork = stage.fork;
  const QImage rest = stage.viewport->grabImage();
  stage.viewport->setPrediction(fork.motion(0.03));  // nothing is solved that could be predicted from
  QVERIFY(stage.viewport->grabImage() == rest);
  stage.viewport->setMotion(fork.problem, fork.motion(0.02));
  stage.viewport->setTau(1.0);
  const QImage solved = stage.viewport->grabImage();
  stage.viewport->setPrediction(fork.motion(0.03));
  const QImage ghost = stage.viewport->grabImage();
  QVERIFY(ghost != solved);
  stage.viewport->setPrediction(fork.motion(0.025));
  QVERIFY(stage.viewport->grabImage() != ghost);
  stage.viewport->clearPrediction();
  QVERIFY(stage.viewport->grabImage() == solved);
}

void TestViewport::staleMotionLooksOtherwise() {
  Stage stage;
  stage.viewport->setMotion(stage.fork.problem, stage.fork.motion(0.02));
  const QImage fresh = stage.viewport->grabImage();
  stage.viewport->setStale(true);
  QVERIFY(stage.viewport->grabImage() != fresh);
  stage.viewport->setStale(false);
  QVERIFY(stage.viewport->grabImage() == fresh);
  stage.viewport->setFieldVisible(false);
  QVERIFY(stage.viewport->grabImage() != fresh);
}

void TestViewport::followsThePalette() {
  Stage stage;
  const auto corner = [&] { return QColor(stage.viewport->grabImage().pixel(2, 2)).lightnessF(); };
  QPalette palette = stage.window.palette();
  palette.setColor(QPalette::Window, QColor(30, 30, 34));
  stage.window.setPalette(palette);
  QVERIFY(corner() < 0.3);
  palette.setColor(QPalette::Window, QColor(240, 240, 240));
  stage.window.setPalette(palette);
  QVERIFY(corner() > 0.8);
}

void TestViewport::keysChangeTheView() {
  Stage stage;
  QList<QImage> pictures{stage.viewport->grabImage()};
  for (int key = Qt::Key_1; key <= Qt::Key_6; ++key) {
    QTest::keyClick(stage.viewport, static_cast<Qt::Key>(key));
    for (const QImage& other : pictures) QVERIFY(stage.viewport->grabImage() != other);
    pictures.append(stage.viewport->grabImage());
  }
  QTest::keyClick(stage.viewport, Qt::Key_0);
  QVERIFY(stage.viewport->grabImage() == pictures.first());
}

void TestViewport::resizingKeepsTheModelInView() {
  Stage stage;
  stage.window.resize(900, 300);
  stage.viewport->setGeometry(0, 0, 900, 300);
  QCOMPARE(stage.viewport->grabImage().size(), (QSizeF(900, 300) * stage.ratio()).toSize());
  const Blob ball = stage.ball();
  QVERIFY(ball.pixels > 20);
  QVERIFY(ball.y > 5 && ball.y < 295);
}

void TestViewport::survivesItsEnd() {
  {
    Stage stage;
    stage.viewport->setMotion(stage.fork.problem, stage.fork.motion(0.02));
    stage.viewport->setPrediction(stage.fork.motion(0.03));
    stage.viewport->play();
    QTest::qWait(40);
  }
  auto second = std::make_unique<Stage>();
  const Stage third;  // two at once
  QVERIFY(second->ball().pixels > 20);
  QVERIFY(third.ball().pixels > 20);
  second->viewport->setModel(nullptr);
  QCOMPARE(second->ball().pixels, 0);
  second.reset();
  QVERIFY(third.ball().pixels > 20);
  // To another top-level window and back, as a dock does that floats.
  QWidget other;
  other.resize(600, 400);
  const QImage before = third.viewport->grabImage();
  third.viewport->setParent(&other);
  third.viewport->show();
  other.show();
  QVERIFY(QTest::qWaitForWindowExposed(&other));
  QVERIFY(third.viewport->grabImage() == before);
  delete third.viewport;
}

}  // namespace pliant::viewport

QTEST_MAIN(pliant::viewport::TestViewport)
#include "test_viewport.moc"
