#include <Eigen/Geometry>
#include <QApplication>
#include <QComboBox>
#include <QMouseEvent>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <cmath>
#include <numbers>

#include "core/mechanics/design_parameter.hpp"
#include "core/scene/json_text.hpp"
#include "ui/panels/compound_row.hpp"
#include "ui/panels/design_panel.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/target_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/target_link.hpp"

using namespace pliant;
using scene::Json;
using shell::MainWindow;

namespace {

constexpr int patience = 60'000;                           // milliseconds
constexpr double viewAngle = 22 * std::numbers::pi / 180;  // from top to bottom
const std::string target = "/studies/2/objectives/0/paths/0";

}  // namespace

/// Target paths drawn by hand, and all parameters moved along a goal, from the window.
class TestTargetWindow : public QObject {
  Q_OBJECT

  viewport::Viewport& viewport() { return window_->viewport(); }
  document::Document& document() { return window_->document(); }
  panels::TargetBar& bar() { return *window_->design().targetBar(); }

  /// Where a point is seen, by the pinhole camera that stands there.
  QPointF placeOf(const Eigen::Vector3d& point) {
    const render::CameraPose pose = viewport().motionView().cameraPose();
    const Eigen::Vector3d forward = (pose.focus - pose.position).normalized();
    const Eigen::Vector3d right = forward.cross(pose.up).normalized(), up = right.cross(forward);
    const Eigen::Vector3d seen = point - pose.position;
    const double scale = 0.5 * viewport().height() / std::tan(0.5 * viewAngle) / seen.dot(forward);
    return {0.5 * viewport().width() + scale * seen.dot(right), 0.5 * viewport().height() - scale * seen.dot(up)};
  }
  void drag(QPointF from, QPointF to, Qt::MouseButton button = Qt::LeftButton) {
    const auto send = [&](QEvent::Type type, QPointF place, Qt::MouseButtons buttons) {
      QMouseEvent event(type, place, viewport().mapToGlobal(place), button, buttons, {});
      QApplication::sendEvent(&viewport(), &event);
    };
    send(QEvent::MouseButtonPress, from, button);
    for (const double part : {0.4, 1.0}) send(QEvent::MouseMove, from + part * (to - from), button);
    send(QEvent::MouseButtonRelease, to, Qt::NoButton);
  }
  std::size_t splineSize() { return document().valueAt(target + "/spline").size(); }

 private Q_SLOTS:
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/three_link.json")));
    viewport().grabImage();
  }
  void cleanup() { window_.reset(); }

  void aTargetIsDrawnByHand() {
    const Json before = document().valueAt(target);
    QCOMPARE(viewport().motionView().targets().size(), std::size_t(1));
    QCOMPARE(viewport().motionView().targets()[0].handles.cols(), Eigen::Index(0));
    // The foot is small on the screen: it is looked at closely.
    const QPointF foot = placeOf(viewport().motionView().targets()[0].curve.rowwise().mean());
    for (int notch = 0; notch < 12; ++notch) {
      QWheelEvent zoom(foot, viewport().mapToGlobal(foot), {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
      QApplication::sendEvent(&viewport(), &zoom);
    }
    bar().drawButton()->click();
    QVERIFY(window_->targets().isDrawing());
    const render::Points first = window_->targets().drawnPoints();
    QVERIFY(first.cols() >= 8);
    QVERIFY(!document().isModified());
    viewport().grabImage();

    // A point goes where the mouse goes; the curve follows on every move, the scene when it is let go.
    const QPointF from = placeOf(first.col(2)), to = from + QPointF(30, -24);
    QMouseEvent press(QEvent::MouseButtonPress, from, viewport().mapToGlobal(from), Qt::LeftButton, Qt::LeftButton, {});
    QApplication::sendEvent(&viewport(), &press);
    const render::Points curve = viewport().motionView().targets()[0].curve;
    QMouseEvent move(QEvent::MouseMove, to, viewport().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&viewport(), &move);
    QVERIFY((viewport().motionView().targets()[0].curve - curve).norm() > 1e-3);
    QVERIFY(viewport().motionView().targets()[0].label.find('(') != std::string::npos);
    QVERIFY(!document().isModified());
    QMouseEvent release(QEvent::MouseButtonRelease, to, viewport().mapToGlobal(to), Qt::LeftButton, {}, {});
    QApplication::sendEvent(&viewport(), &release);
    QCOMPARE(document().undoStack().index(), 1);
    QCOMPARE(splineSize(), static_cast<std::size_t>(first.cols()));
    QVERIFY(!document().valueAt(target).contains("points"));
    const QPointF reached = placeOf(window_->targets().drawnPoints().col(2)) - to;
    QVERIFY2(std::hypot(reached.x(), reached.y()) < 1.5, qPrintable(QString::number(reached.manhattanLength())));

    // On the curve between two points there will be another one; a right click takes one away.
    const render::Points drawn = viewport().motionView().targets()[0].curve;
    const QPointF between = placeOf(drawn.col(drawn.cols() / first.cols() * 2 + 12));
    drag(between, between + QPointF(6, 6));
    QCOMPARE(splineSize(), static_cast<std::size_t>(first.cols() + 1));
    const QPointF last = placeOf(window_->targets().drawnPoints().col(0));
    drag(last, last, Qt::RightButton);
    QCOMPARE(splineSize(), static_cast<std::size_t>(first.cols()));
    QCOMPARE(document().undoStack().index(), 3);

    // What is beside it turns the view as ever.
    const render::CameraPose pose = viewport().motionView().cameraPose();
    drag({20, 20}, {60, 30});
    QVERIFY((viewport().motionView().cameraPose().position - pose.position).norm() > 1e-3);
    QCOMPARE(document().undoStack().index(), 3);

    while (document().undoStack().canUndo()) document().undoStack().undo();
    QVERIFY(document().valueAt(target) == before);
    QVERIFY(window_->targets().isDrawing());
    QCOMPARE(window_->targets().drawnPoints().cols(), first.cols());
    QTest::keyClick(&viewport(), Qt::Key_Escape);
    QVERIFY(!window_->targets().isDrawing() && !bar().drawButton()->isChecked());
    QCOMPARE(viewport().motionView().targets()[0].handles.cols(), Eigen::Index(0));
  }

  void aProbeWithoutATargetGetsOne() {
    bar().probeChoice()->setCurrentText(QStringLiteral("ankle"));
    bar().drawButton()->click();
    QVERIFY(window_->targets().isDrawing());
    QCOMPARE(document().valueAt("/studies/2/objectives/0/paths").size(), std::size_t(2));
    QVERIFY(document().valueAt("/studies/2/objectives/0/paths/1/probe") == "ankle");
    QCOMPARE(viewport().motionView().targets().size(), std::size_t(2));
    document().undoStack().undo();
    QVERIFY(!window_->targets().isDrawing());
    QCOMPARE(viewport().motionView().targets().size(), std::size_t(1));
  }

  void aTableGivesATarget() {
    const QTemporaryDir folder;
    const QString file = folder.filePath("path.csv");
    scene::writeTextFile(file.toStdString(), "x [m],y [m]\n0.01,0\n0,0.02\n-0.01,0\n0,-0.02\n");
    window_->targets().takeTable(file);
    QCOMPARE(document().valueAt(target + "/points").size(), std::size_t(4));
    QCOMPARE(document().valueAt(target + "/points/1/1").get<double>(), 0.02);
    scene::writeTextFile(file.toStdString(), "a,b\n1,2\n1,2\n1,2\n");
    window_->targets().takeTable(file);
    QVERIFY(!window_->messages().sentence().isEmpty());
    QCOMPARE(document().undoStack().index(), 1);
  }

  void aMotionGivesATargetAndAllParametersFollowAGoal() {
    jobs::MotionSession& session = window_->session();
    session.run({"walk"});
    QTRY_VERIFY_WITH_TIMEOUT(session.shown() && session.shown()->sensitivity && !session.isBusy(), patience);
    window_->targets().takeMotion("ankle");
    const auto& shown = *session.shown();
    const int ankle = document().model()->probes.at(1).node;
    const mechanics::Matrix path = shown.problem->nodeTrajectory(shown.motion.z, ankle);
    const Json points = document().valueAt(target + "/points");
    QCOMPARE(points.size(), std::size_t(64));
    QVERIFY(std::abs(points[0][0].get<double>() - path(0, 0)) < 1e-4 * std::abs(path(0, 0)) + 1e-9);
    document().undoStack().undo();

    // How far predictions can be trusted is found behind it.
    const jobs::TrustedRanges& trust = window_->parameters().trust();
    const std::string probed = document().model()->parameters.back()->pointer();
    QTRY_VERIFY_WITH_TIMEOUT(trust.range(probed).has_value(), patience);
    const auto range = trust.range(probed).value();
    const double here = document().model()->parameters.back()->value(*document().model());
    QVERIFY(range.lower < here && here < range.upper);
    const panels::ParameterSlider& judged = *window_->parameters().row(probed)->slider();
    QCOMPARE(judged.trustAt(range.lower), 1.0);
    QVERIFY(judged.toolTip().contains(QStringLiteral("10 %")));

    panels::CompoundRow& all = *window_->parameters().compound();
    QVERIFY(all.isVisible());
    QCOMPARE(all.choice()->count(), 3);
    const double solved = session.shownAmplitude();
    const auto model = document().model();
    const auto firstPointer = model->parameters.front()->pointer();
    panels::ParameterRow& locked = *window_->parameters().row(firstPointer);
    QVERIFY(locked.slider()->plannedStep() != 0);
    locked.lockButton()->click();
    QCOMPARE(locked.slider()->plannedStep(), 0.0);

    panels::ParameterSlider& slider = *all.slider();
    QTest::mousePress(&slider, Qt::LeftButton, {}, slider.handlePosition());
    QTest::mouseMove(&slider, slider.handlePosition() + QPoint(20, 0));
    QVERIFY(session.prediction().has_value());
    QVERIFY(*session.predictedAmplitude() > 1.001 * solved);
    QVERIFY(all.text().contains(QStringLiteral("predicted")));
    QVERIFY(!document().isModified());
    int moved = 0;
    for (const auto& parameter : model->parameters) {
      const panels::ParameterSlider& own = *window_->parameters().row(parameter->pointer())->slider();
      moved += own.realValue() != parameter->value(*model);
      QVERIFY(own.realValue() >= own.realMinimum() && own.realValue() <= own.realMaximum());
    }
    QVERIFY(moved > 1);
    QCOMPARE(locked.slider()->realValue(), model->parameters.front()->value(*model));
    const double predicted = *session.predictedAmplitude();
    QTest::mouseRelease(&slider, Qt::LeftButton, {}, slider.handlePosition());

    // One step of undo, and the same prediction from the scene as it is now.
    QTRY_COMPARE_WITH_TIMEOUT(document().undoStack().index(), 1, patience);
    QCOMPARE(slider.realValue(), 0.0);
    QTRY_VERIFY_WITH_TIMEOUT(session.predictedAmplitude().has_value(), patience);
    QVERIFY(std::abs(*session.predictedAmplitude() / predicted - 1) < 1e-2);  // values are written with four digits
    QVERIFY(document().valueAt(firstPointer) == document().savedValueAt(firstPointer));
    document().undoStack().undo();
    QVERIFY(!document().isModified() && !session.prediction());
  }

 private:
  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestTargetWindow)
#include "test_target_window.moc"
