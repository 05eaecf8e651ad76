#include <QImage>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "tests/ui/render/hanging_sheet.hpp"
#include "tests/ui/render/swinging_fork.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {

namespace {
using FrameClock = Viewport::FrameClock;

/// Any view with frames.
class CountingView final : public render::FrameView {
 public:
  void setFrame(int frame) override { frame_ = frame; }
  int frame() const override { return frame_; }
  std::optional<int> pickNode(double, double, double) const override { return std::nullopt; }

 private:
  int frame_ = -1;
};

}  // namespace

/// Cloth playback: time, frames that grow, back to the model.
class TestViewportCloth : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    viewport_ = std::make_unique<Viewport>();
    viewport_->resize(480, 320);
    viewport_->setModel(sheet_.problem->model);
    viewport_->show();
    QVERIFY(QTest::qWaitForWindowExposed(viewport_.get()));
    viewport_->setCloth(sheet_.problem);
  }
  void cleanup() { viewport_.reset(); }

  /// What is exported is what is on the screen, from where it is seen.
  void filmsLookLikeTheViewport() {
    viewport_->resize(800, 720);
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    viewport_->setCaption("Sheet");
    viewport_->setSelectedNode(20);
    viewport_->clothView().setField(render::ClothField::limitForce);
    viewport_->clothView().setDirectionsVisible(true);
    viewport_->setAxisView(render::AxisView::right);
    viewport_->clothView().orbit(0.1, 0.05);
    viewport_->clothView().zoom(1.2, 300, 200);
    viewport_->setClothSpeed(0.5);
    viewport_->setTime(1);
    const render::FilmOptions options = viewport_->filmOptions();
    QCOMPARE(options.picture.width, 800);
    QCOMPARE(options.picture.height, 720);
    QCOMPARE(options.picture.caption, std::string("Sheet"));
    QTemporaryDir folder;
    base::ExecutionContext context;
    const auto film = render::filmCloth(
        sheet_.problem, sheet_.frames, FrameClock::seconds, options, folder.filePath("a.png").toStdString(), context);
    QCOMPARE(film->rate.perSecond(), 5.0);  // frames of 10 Hz at half the speed
    const QImage last = QImage(folder.filePath("a_00010.png")).convertToFormat(QImage::Format_RGB32);
    const QImage screen = viewport_->grabImage().convertToFormat(QImage::Format_RGB32);
    const QRect belowCaption(0, 80, 800, 640);  // the film's has the time as well
    QVERIFY(last.copy(belowCaption) == screen.copy(belowCaption));
    QVERIFY(last != screen);
    // A small viewport makes a film that is large enough, with the same in view.
    viewport_->resize(400, 301);
    QCOMPARE(viewport_->filmOptions().picture.height, 720);
    QCOMPARE(viewport_->filmOptions().picture.width, 956);
  }

  void timeChoosesTheFrame() {
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    QSignalSpy changed(viewport_.get(), &Viewport::timeChanged);
    for (int i = 0; i <= 10; ++i) {
      viewport_->setTime(0.1 * i);
      QCOMPARE(viewport_->clothView().frame(), i);
      viewport_->setTime(0.1 * i + 0.05);
      QCOMPARE(viewport_->clothView().frame(), i);
    }
    QCOMPARE(changed.count(), 22);
    viewport_->setTime(99);
    QVERIFY(std::abs(viewport_->time() - 1.0) < 1e-12);
    viewport_->setTime(-1);
    QCOMPARE(viewport_->clothView().frame(), 0);
    viewport_->setTime(NAN);
    QCOMPARE(viewport_->time(), 0.0);
  }

  void theNewestFrameIsShownWhileTheyGrow() {
    const auto first = [&](int count) { return std::vector(sheet_.frames.begin(), sheet_.frames.begin() + count); };
    viewport_->setClothFrames(first(2), true, FrameClock::seconds);
    QCOMPARE(viewport_->clothView().frame(), 1);
    viewport_->setClothFrames(first(5), true, FrameClock::seconds);
    QCOMPARE(viewport_->clothView().frame(), 4);
    // One that was chosen stays, until the newest is chosen.
    viewport_->setTime(0.2);
    viewport_->setClothFrames(first(7), true, FrameClock::seconds);
    QCOMPARE(viewport_->clothView().frame(), 2);
    viewport_->setTime(viewport_->duration());
    viewport_->setClothFrames(first(9), true, FrameClock::seconds);
    QCOMPARE(viewport_->clothView().frame(), 8);
    // At its end it stays where it is.
    viewport_->setTime(0.3);
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    QCOMPARE(viewport_->clothView().frame(), 3);
  }

  void itPlaysAndBeginsAgain() {
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    viewport_->setTime(0.9);
    viewport_->setClothSpeed(20);
    QSignalSpy changed(viewport_.get(), &Viewport::timeChanged);
    viewport_->play();
    const auto beganAgain = [&] {
      for (qsizetype i = 1; i < changed.size(); ++i)
        if (changed[i][0].toDouble() < changed[i - 1][0].toDouble()) return true;
      return false;
    };
    QTRY_VERIFY_WITH_TIMEOUT(beganAgain(), 30'000);
    viewport_->pause();
  }

  /// A guest has its own frames, and its own place in them.
  void guestsHaveFrames() {
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    viewport_->setTime(0.7);
    QSignalSpy changed(viewport_.get(), &Viewport::clothChanged);
    const auto guest = std::make_shared<CountingView>();
    viewport_->setGuest(guest);
    QVERIFY(changed.count() > 0 && !viewport_->showsFrames());
    viewport_->setGuestFrames({0, 0.5}, true, FrameClock::loads);
    QVERIFY(viewport_->showsFrames() && viewport_->frameClock() == FrameClock::loads);
    QCOMPARE(guest->frame(), 1);  // the newest
    viewport_->setTime(0.4);
    QCOMPARE(guest->frame(), 0);
    viewport_->setGuestFrames({0, 0.5, 1}, true, FrameClock::loads);
    QCOMPARE(guest->frame(), 0);  // which was chosen
    viewport_->setTime(1);
    viewport_->setGuestFrames({0, 0.5, 1, 1.5}, false, FrameClock::loads);
    QCOMPARE(guest->frame(), 2);
    QCOMPARE(viewport_->duration(), 1.5);
    viewport_->setClothSpeed(20);
    viewport_->play();
    QTRY_COMPARE_WITH_TIMEOUT(guest->frame(), 3, 30'000);
    QTRY_COMPARE_WITH_TIMEOUT(guest->frame(), 0, 30'000);
    viewport_->setGuestFrames({}, false, FrameClock::seconds);  // one that stands still
    QVERIFY(!viewport_->isPlaying() && !viewport_->showsFrames());
    viewport_->setGuest(nullptr);
    QVERIFY(viewport_->frameClock() == FrameClock::seconds);
    QCOMPARE(viewport_->time(), 0.7);
    QCOMPARE(viewport_->clothView().frame(), 7);
  }

  void theModelComesBack() {
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    viewport_->setTime(0.7);
    const QImage cloth = viewport_->grabImage();
    const render::SwingingFork fork;
    viewport_->setModel(fork.model);
    QVERIFY(!viewport_->showsCloth());
    QCOMPARE(viewport_->duration(), 0.0);
    const QImage model = viewport_->grabImage();
    QVERIFY(model != cloth);
    viewport_->setCloth(sheet_.problem);
    viewport_->setClothFrames(sheet_.frames, false, FrameClock::seconds);
    viewport_->setTime(0.7);
    viewport_->fit();
    QVERIFY(viewport_->grabImage() != model);
    viewport_->setCloth(nullptr);
    QVERIFY(viewport_->grabImage() == model);
  }

 private:
  render::HangingSheet sheet_;
  std::unique_ptr<Viewport> viewport_;
};

}  // namespace pliant::viewport

QTEST_MAIN(pliant::viewport::TestViewportCloth)
#include "test_viewport_cloth.moc"
