#include <QAction>
#include <QComboBox>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "tests/ui/panels/sheet_scene.hpp"
#include "ui/panels/limit_panel.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/plots/polar_editor.hpp"
#include "ui/shell/live_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using shell::MainWindow;

namespace {
constexpr int patience = 30'000;  // milliseconds
}

/// A live cloth in the whole window.
class TestLiveWindow : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QFile file(folder_.filePath("sheet.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(sheetScene);
  }

  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(window_->document().open(folder_.filePath("sheet.json")));
  }
  void cleanup() { window_.reset(); }

  void itIsOfferedWhereThereIsACloth() {
    auto* bar = window_->findChild<shell::LiveBar*>();
    QVERIFY(bar->isVisible());
    QCOMPARE(bar->study(), std::string("swing"));
    QVERIFY(action("live.open")->isEnabled());
    QVERIFY(!action("live.record")->isEnabled());
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!bar->isVisible());
    QVERIFY(!action("live.open")->isEnabled());
  }

  void theMouseTakesANodeAndLetsItGo() {
    goLive();
    viewport::Viewport& viewport = window_->viewport();
    action("view.play")->trigger();
    QTRY_VERIFY(!window_->live().isPlaying());
    const auto [place, node] = freeNode();
    const Eigen::Vector3d before = viewport.clothView().nodePosition(node);
    // Towards a pin, which no limit forbids.
    const auto corner = pixelOf(0);
    QVERIFY(corner);
    const QPoint goal = place + (*corner - place) * 2 / 5;
    QVERIFY((goal - place).manhattanLength() > 40);
    QTest::mousePress(&viewport, Qt::LeftButton, {}, place);
    QCOMPARE(viewport.pulledNode(), std::optional(node));
    QTest::mouseMove(&viewport, (place + goal) / 2);
    QTest::mouseMove(&viewport, goal);
    action("view.play")->trigger();
    // The node goes where the mouse is, in the plane that faces the camera.
    const auto underMouse = [&] { return viewport.clothView().pickNode(goal.x(), goal.y(), 8).value_or(-1); };
    QTRY_COMPARE_WITH_TIMEOUT(underMouse(), node, patience);
    QVERIFY((viewport.clothView().nodePosition(node) - before).norm() > 0.01);
    QTest::mouseRelease(&viewport, Qt::LeftButton, {}, goal);
    QVERIFY(!viewport.pulledNode());
    QTRY_VERIFY_WITH_TIMEOUT(window_->live().state().held.empty(), patience);
    // With Ctrl it stays, and a click with Ctrl frees it again.
    const auto [second, other] = freeNode();
    QTest::mouseClick(&viewport, Qt::LeftButton, Qt::ControlModifier, second);
    QTRY_COMPARE_WITH_TIMEOUT(window_->live().state().held.size(), std::size_t(1), patience);
    QTest::qWait(50);
    const int held = window_->live().state().held[0].node;
    QTRY_VERIFY(pixelOf(held).has_value());
    QTest::mouseClick(&viewport, Qt::LeftButton, Qt::ControlModifier, *pixelOf(held));
    QTRY_VERIFY_WITH_TIMEOUT(window_->live().state().held.empty(), patience);
  }

  void whatIsReachedAndEditedIsLive() {
    goLive();
    plots::PolarEditor& editor = *window_->limits().editor();
    QTRY_VERIFY_WITH_TIMEOUT(
        editor.picture().reached.size() > 0 && editor.picture().reached.maxCoeff() > 1.001, patience);
    const auto problem = window_->live().state().problem;
    editor.putHandle(0, {0, 1.03});
    QTRY_VERIFY_WITH_TIMEOUT(window_->live().state().problem != problem, patience);
    QTRY_VERIFY_WITH_TIMEOUT(window_->viewport().clothProblem() != problem, patience);
    QVERIFY(window_->viewport().isLive());
  }

  void aRecordingPlaysAfterwards() {
    goLive();
    viewport::Viewport& viewport = window_->viewport();
    action("live.record")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(window_->live().state().recordedSeconds > 0.1, patience);
    action("live.open")->trigger();
    QVERIFY(!window_->live().isOpen() && !viewport.isLive());
    QTRY_VERIFY_WITH_TIMEOUT(viewport.clothFrames().size() > 5, patience);
    QVERIFY(viewport.isPlaying());
    QVERIFY(viewport.duration() > 0.1);
  }

  void aHandThatPullsTooFarIsTold() {
    goLive();
    viewport::Viewport& viewport = window_->viewport();
    const auto [place, node] = freeNode();
    QTest::mousePress(&viewport, Qt::LeftButton, {}, place);
    const QPoint outside = viewport.rect().topRight() + QPoint(-4, 4);
    QTest::mouseMove(&viewport, (place + outside) / 2);
    QTest::mouseMove(&viewport, outside);
    Q_EMIT viewport.nodePulled(node, Eigen::Vector3d(5, 5, 5));
    QTRY_VERIFY_WITH_TIMEOUT(!window_->live().state().obstacle.isEmpty(), patience);
    QTRY_VERIFY(window_->messages().sentence().contains(QStringLiteral("Node %1").arg(node)));
    const double then = window_->live().state().frame->time;
    QTRY_VERIFY_WITH_TIMEOUT(window_->live().state().frame->time > then, patience);
    QTest::mouseRelease(&viewport, Qt::LeftButton, {}, outside);
  }

  void theWindowClosesWhileItRuns() {
    goLive();
    const auto [place, node] = freeNode();
    QTest::mousePress(&window_->viewport(), Qt::LeftButton, {}, place);
    QTest::mouseMove(&window_->viewport(), place + QPoint(50, 0));
    action("live.record")->trigger();
    window_->close();
    window_.reset();
  }

  void anotherSceneEndsIt() {
    goLive();
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!window_->live().isOpen());
    QVERIFY(!window_->viewport().isLive() && !window_->viewport().showsCloth());
  }

 private:
  QAction* action(const char* id) { return window_->actions().find(QLatin1String(id)); }

  void goLive() {
    action("live.open")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(window_->viewport().isLive() && window_->viewport().showsCloth(), patience);
    QVERIFY(window_->live().isPlaying());
    QTRY_VERIFY_WITH_TIMEOUT(window_->live().state().frame->time > 0.1, patience);
  }

  std::optional<QPoint> pixelOf(int node) {
    viewport::Viewport& viewport = window_->viewport();
    for (int y = 4; y < viewport.height(); y += 4)
      for (int x = 4; x < viewport.width(); x += 4)
        if (viewport.clothView().pickNode(x, y, 4) == node) return QPoint(x, y);
    return std::nullopt;
  }

  /// The middle of the first sheet, which no pin holds.
  std::pair<QPoint, int> freeNode() {
    constexpr int middle = 40;
    const auto place = pixelOf(middle);
    return {place.value_or(QPoint()),
            place ? window_->viewport().clothView().pickNode(place->x(), place->y(), 12).value_or(-1) : -1};
  }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestLiveWindow)
#include "test_live_window.moc"
