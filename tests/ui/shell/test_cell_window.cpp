#include <QAction>
#include <QDockWidget>
#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QPushButton>
#include <QRadioButton>
#include <QTest>
#include <cmath>

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_families.hpp"
#include "ui/panels/cell_panel.hpp"
#include "ui/panels/cell_parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/shell/cell_bar.hpp"
#include "ui/shell/element_gallery.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using shell::MainWindow;

namespace {
constexpr int patience = 60'000;  // milliseconds
}

/// An interlocking material in the whole window.
class TestCellWindow : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
  }
  void cleanup() { window_.reset(); }

  void aSceneOfCellsIsSeenAtItsNativeScale() {
    openThreefold();
    QVERIFY(window_->cellBar().isVisible());
    QVERIFY(dock("material")->isVisible());
    QVERIFY(!dock("response")->isVisible() && !dock("limits")->isVisible());
    QVERIFY(action("cell.reset")->isEnabled());
    // Another scene has none of it.
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!window_->viewport().showsCell());
    QVERIFY(!window_->cellBar().isVisible() && !dock("material")->isVisible());
    QVERIFY(!action("cell.reset")->isEnabled());
  }

  /// The handle of the right side, pulled far to the right: the cell locks at its limit, and says so.
  void aHandlePullsTheCellUntilItLocks() {
    openThreefold();
    viewport::Viewport& viewport = window_->viewport();
    action("view.top")->trigger();
    const render::CellPick side = viewport.cellView().handles()[3];
    const QPoint place = pixelOf(side.place), goal = place + QPoint(150, 0);
    QTest::mousePress(&viewport, Qt::LeftButton, {}, place);
    QVERIFY(viewport.heldGrip() && viewport.heldGrip()->handle);
    QTest::mouseMove(&viewport, (place + goal) / 2);
    QTest::mouseMove(&viewport, goal);
    QTRY_VERIFY_WITH_TIMEOUT(window_->liveCell().state().step.locked, patience);
    const double reached = interlock::strainAlong(window_->liveCell().state().state.strain, 0);
    const double limit = interlock::directionLimit(interlock::CellSolver(interlock::threefold()), 0, false).strain;
    // The hand is held level, which pulls the least bit to the side as well.
    QVERIFY(std::abs(reached - limit) < 2e-3);
    QTRY_VERIFY(window_->cellBar().text().contains("locked: "));
    QVERIFY(window_->cellBar().text().contains("x +8."));
    QVERIFY(viewport.cellView().state().strain == window_->liveCell().state().state.strain);
    QTest::mouseRelease(&viewport, Qt::LeftButton, {}, goal);
    QVERIFY(!viewport.heldGrip());
    QTRY_VERIFY_WITH_TIMEOUT(!window_->liveCell().state().pulled, patience);
    action("cell.reset")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(viewport.cellView().state().strain.norm() == 0, patience);
    QTRY_VERIFY(window_->cellBar().text().startsWith("Drag an element"));
  }

  void anElementIsPulledAndTheRestTurnsTheView() {
    openThreefold();
    viewport::Viewport& viewport = window_->viewport();
    // Somewhere on an element that is no neighbour's handle.
    std::optional<QPoint> place;
    for (int x = viewport.width() / 2 - 60; x < viewport.width() / 2 + 60 && !place; x += 4) {
      const auto pick = viewport.cellView().pick(x, viewport.height() / 2.0, 3);
      if (pick && !pick->handle) place = QPoint(x, viewport.height() / 2);
    }
    QVERIFY(place);
    const interlock::CellState before = viewport.cellView().state();
    QTest::mousePress(&viewport, Qt::LeftButton, {}, *place);
    QVERIFY(viewport.heldGrip() && !viewport.heldGrip()->handle);
    QTest::mouseMove(&viewport, *place + QPoint(20, 10));
    QTest::mouseMove(&viewport, *place + QPoint(40, 20));
    QTRY_VERIFY_WITH_TIMEOUT((viewport.cellView().state().rotations[0] - before.rotations[0]).norm() +
                                     (viewport.cellView().state().strain - before.strain).norm() >
                                 1e-3,
                             patience);
    QTest::keyClick(&viewport, Qt::Key_Escape);
    QVERIFY(!viewport.heldGrip());
    QTest::mouseRelease(&viewport, Qt::LeftButton, {}, *place + QPoint(40, 20));
    const auto pose = viewport.cellView().cameraPose();
    QTest::mousePress(&viewport, Qt::RightButton, {}, *place);
    QTest::mouseMove(&viewport, *place + QPoint(30, 0));
    QTest::mouseMove(&viewport, *place + QPoint(60, 0));
    QTest::mouseRelease(&viewport, Qt::RightButton, {}, *place + QPoint(60, 0));
    QVERIFY((viewport.cellView().cameraPose().position - pose.position).norm() > 1e-6);
  }

  void theGalleryReplacesTheMaterialOrOpensAScene() {
    openThreefold();
    action("model.elements")->trigger();
    QVERIFY(window_->elements().isVisible());
    window_->elements().card("ring_net")->click();
    QTRY_COMPARE_WITH_TIMEOUT(
        window_->document().valueAt("/interlocking_cells/0/type"), scene::Json("ring_net"), patience);
    QCOMPARE(window_->document().undoStack().count(), 1);
    QVERIFY(!window_->elements().isVisible());
    QTRY_COMPARE_WITH_TIMEOUT(shownElements(), std::size_t(3), patience);
    action("edit.undo")->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(shownElements(), std::size_t(1), patience);
    QVERIFY(!window_->document().isModified());
    action("model.elements")->trigger();
    window_->elements().opensScene()->setChecked(true);
    window_->elements().card("four_in_one")->click();
    QTRY_COMPARE_WITH_TIMEOUT(shownElements(), std::size_t(2), patience);
    QVERIFY(window_->document().file().isEmpty());
    QCOMPARE(window_->document().title(), QString("4-in-1 chain mail"));
    QCOMPARE(window_->document().studies().size(), std::size_t(4));
  }

  void anEmptyWindowOpensAMaterial() {
    QVERIFY(window_->document().isEmpty());
    action("model.elements")->trigger();
    QVERIFY(window_->elements().isVisible());
    window_->elements().card("torus_knot")->click();
    QTRY_VERIFY_WITH_TIMEOUT(window_->viewport().showsCell(), patience);
    QVERIFY(!window_->elements().isVisible());
  }

  /// While a number is dragged the picture follows, overlaps and all; then what fits comes back.
  void thePictureFollowsADrag() {
    openThreefold();
    const auto before = window_->viewport().cellView().cell();
    auto* slider = window_->cellPanel().row("wire_radius")->slider();
    const QPoint begin = slider->handlePosition(), end = begin + QPoint(90, 0);
    QTest::mousePress(slider, Qt::LeftButton, {}, begin);
    QTest::mouseMove(slider, end);
    QTRY_VERIFY_WITH_TIMEOUT(window_->viewport().cellView().cell()->smallestRadius() > 1.3e-3, patience);
    QTRY_VERIFY(window_->cellBar().text().contains("overlap by"));
    QTest::mouseRelease(slider, Qt::LeftButton, {}, end);
    QTRY_VERIFY_WITH_TIMEOUT(window_->cellPanel().isRefused(), patience);
    QCOMPARE(window_->viewport().cellView().cell(), before);
    QCOMPARE(window_->document().undoStack().count(), 0);
  }

 private:
  void openThreefold() {
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/interlock/threefold.json")));
    QTRY_VERIFY_WITH_TIMEOUT(window_->viewport().showsCell(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(window_->liveCell().state().step.smallestGap > 0, patience);
    QCOMPARE(shownElements(), std::size_t(1));
  }
  std::size_t shownElements() {
    const auto& cell = window_->viewport().cellView().cell();
    return cell ? cell->elements.size() : 0;
  }
  QAction* action(const char* id) { return window_->actions().find(QLatin1String(id)); }
  QDockWidget* dock(const char* name) { return window_->findChild<QDockWidget*>(QLatin1String(name)); }
  QPoint pixelOf(const Eigen::Vector3d& place) {
    const auto pixel = window_->viewport().cellView().pixelOf(place);
    if (!pixel) return {};
    const double ratio = window_->viewport().devicePixelRatioF();
    return {static_cast<int>(std::lround(pixel->x() / ratio)),
            static_cast<int>(std::lround(window_->viewport().height() - pixel->y() / ratio))};
  }

  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestCellWindow)
#include "test_cell_window.moc"
