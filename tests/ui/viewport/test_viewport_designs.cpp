#include <QApplication>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "tests/ui/render/pixels.hpp"
#include "tests/ui/render/swinging_fork.hpp"
#include "ui/render/motion_pair.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {
namespace {

/// The halves begin at other pixels, so the rounding of an edge may fall on the other side: a thousandth of the pixels.
/// A shift by a pixel would change thousands.
constexpr int roundedEdges = 300 * 400 / 1000;
constexpr int fullWidth = 601, fullHeight = 400;  // two halves of 300 pixels and the line between them

QImage halfOf(const QImage& picture, bool right) {
  return picture.copy(right ? 301 : 0, 0, 300, fullHeight).convertToFormat(QImage::Format_RGB32);
}

/// Where the pictures differ by more than rounding; without the corner of the axes.
int differingPixels(const QImage& a, const QImage& b) {
  const auto differ = [](int p, int q) { return std::abs(p - q) > 3; };
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QColor p = a.pixelColor(x, y), q = b.pixelColor(x, y);
      if (x < 100 && y >= a.height() - 100) continue;
      if (differ(p.red(), q.red()) || differ(p.green(), q.green()) || differ(p.blue(), q.blue())) ++count;
    }
  return count;
}

}  // namespace

/// Two motions in one viewport.
class TestViewportDesigns : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    window_ = std::make_unique<QWidget>();
    window_->resize(fullWidth, fullHeight);
    viewport_ = new Viewport(window_.get());
    viewport_->setGeometry(0, 0, fullWidth, fullHeight);
    viewport_->setModel(fork_.model);
    viewport_->setFieldVisible(false);
    viewport_->setMotion(fork_.problem, fork_.motion(0.02));
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    if (viewport_->devicePixelRatioF() != 1) QSKIP("written for a screen of one pixel a pixel");
  }
  void cleanup() { window_.reset(); }

  void bothHalvesOfOneMotionAreAlike() {
    viewport_->setBeside(fork_.problem, fork_.motion(0.02), {});
    for (const double tau : {0.0, 2.0}) {
      viewport_->setTau(tau);
      const QImage picture = viewport_->grabImage();
      QVERIFY(differingPixels(halfOf(picture, false), halfOf(picture, true)) <= roundedEdges);
    }
    viewport_->setBeside(fork_.problem, fork_.motion(0.03), {});
    const QImage other = viewport_->grabImage();
    QVERIFY(differingPixels(halfOf(other, false), halfOf(other, true)) > 500);
  }

  void oneCameraTurnsBoth() {
    viewport_->setBeside(fork_.problem, fork_.motion(0.02), {});
    viewport_->setTau(1);
    const QImage before = viewport_->grabImage();
    const QPointF place(450, 200);  // in the right half
    QWheelEvent zoom(place, viewport_->mapToGlobal(place), {}, {0, 240}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(viewport_, &zoom);
    QTest::mousePress(viewport_, Qt::LeftButton, {}, {400, 200});
    const QPointF to(430, 260);
    QMouseEvent move(QEvent::MouseMove, to, viewport_->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(viewport_, &move);
    QTest::mouseRelease(viewport_, Qt::LeftButton, {}, to.toPoint());
    const QImage turned = viewport_->grabImage();
    QVERIFY(turned != before);
    QVERIFY(differingPixels(halfOf(turned, false), halfOf(turned, true)) <= roundedEdges);
  }

  void nodesArePickedInBothHalves() {
    viewport_->setBeside(fork_.problem, fork_.motion(0.02), {});
    viewport_->setAxisView(render::AxisView::top);
    int hits = 0;
    for (int x = 20; x < 300; x += 4)
      for (int y = 20; y < 380; y += 4) {
        const auto left = viewport_->nodeAt(QPointF(x, y)), right = viewport_->nodeAt(QPointF(x + 301, y));
        QVERIFY(left == right);
        hits += left.has_value();
      }
    QVERIFY(hits > 10);
  }

  /// The same scale of colours: what the wider swing reaches.
  void oneScaleOfColours() {
    viewport_->setFieldVisible(true);
    const render::FieldRange own = viewport_->motionView().fieldRange();
    viewport_->setBeside(fork_.problem, fork_.motion(0.04), {});
    QVERIFY(viewport_->pair()->right().fieldRange().most > own.most);
    const QImage wide = viewport_->grabImage();
    // The narrow swing beside itself has other colours.
    viewport_->setBeside(fork_.problem, fork_.motion(0.02), {});
    viewport_->setTau(1);
    viewport_->setTau(0);
    QVERIFY(differingPixels(wide.copy(0, 0, 240, fullHeight), viewport_->grabImage().copy(0, 0, 240, fullHeight)) >
            100);
  }

  void theMotionGetsTheViewportBack() {
    viewport_->setFieldVisible(true);
    viewport_->fit();
    const QImage before = viewport_->grabImage();
    viewport_->setBeside(fork_.problem, fork_.motion(0.04), QStringLiteral("wide"));
    QVERIFY(viewport_->grabImage() != before);
    viewport_->clearBeside();
    QVERIFY(!viewport_->pair());
    QVERIFY(viewport_->grabImage() == before);
  }

  void aGhostOfAnotherDesignIsBroughtIntoView() {
    viewport_->fit();
    const QImage before = viewport_->grabImage();
    auto changed = std::make_shared<mechanics::Model>(*fork_.model);
    changed->restPositions *= 1.5;
    const auto problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(changed, math::HarmonicBasis(3, 32));
    viewport_->setGhost(problem, problem->restCoefficients(), QStringLiteral("best"));
    const QImage both = viewport_->grabImage();
    const auto picture = [](const QImage& image) {
      const QImage rgba = image.convertToFormat(QImage::Format_RGBA8888);
      render::Image result{rgba.width(), rgba.height(), {}};
      result.pixels.assign(rgba.constBits(), rgba.constBits() + rgba.sizeInBytes());
      return result;
    };
    const auto orange = [](int red, int green, int blue) { return red > green + 60 && green > blue + 30; };
    QCOMPARE(render::findBlob(picture(before), orange).pixels, 0);
    const render::Blob ghost = render::findBlob(picture(both), orange);
    QVERIFY(ghost.pixels > 300);
    QVERIFY(ghost.left > 0 && ghost.right < fullWidth - 1 && ghost.bottom < fullHeight - 1);
    viewport_->clearPrediction();
    viewport_->fit();
    QVERIFY(viewport_->grabImage() == before);
  }

  void anotherModelEndsTheComparison() {
    viewport_->setBeside(fork_.problem, fork_.motion(0.03), {});
    viewport_->setModel(fork_.model);
    QVERIFY(!viewport_->pair());
  }

 private:
  render::SwingingFork fork_;
  std::unique_ptr<QWidget> window_;
  Viewport* viewport_ = nullptr;
};

}  // namespace pliant::viewport

QTEST_MAIN(pliant::viewport::TestViewportDesigns)
#include "test_viewport_designs.moc"
