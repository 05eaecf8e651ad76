#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QImage>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/macro_strains.hpp"
#include "tests/core/scene/strain_box.hpp"
#include "ui/panels/sheet_panel.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/shell/exporter.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/playback_bar.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using document::StudyStatus;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

constexpr const char* motionScene = R"({
  "schema_version": 1,
  "title": "A sheet that swings",
  "interlocking_cells": [{"name": "material", "type": "threefold"}],
  "bodies": [{"name": "floor", "type": "ground", "point": [0, 0, "-200 mm"], "size": "0.3 m"}],
  "studies": [
    {"name": "swing", "type": "macro_motion", "shape": "hexagon", "radius": "40 mm", "rings": 4,
     "stretch_limits": "box.obj", "grips": [{"point": ["40 mm", 0], "path": [{"time": 0}]}],
     "duration": "0.2 s", "time_step": "10 ms", "frame_every": 2},
    {"name": "press", "type": "macro_equilibrium", "shape": "hexagon", "radius": "40 mm", "rings": 4,
     "stretch_limits": "box.obj", "clamps": [{"point": ["40 mm", 0]}, {"point": ["-40 mm", 0]}]}]
})";

}  // namespace

/// The motion of a large piece in the whole window: played, scrubbed, charted and exported.
class TestSheetMotionWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;

  viewport::Viewport& viewport() { return window_->viewport(); }
  std::shared_ptr<render::MacroView> view() { return std::dynamic_pointer_cast<render::MacroView>(viewport().guest()); }
  std::shared_ptr<const scene::MacroResult> result() {
    return std::dynamic_pointer_cast<const scene::MacroResult>(window_->document().study("swing")->result);
  }
  void run(const char* study) {
    window_->session().run({study});
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study(study)->status == StudyStatus::solved, patience);
  }

 private Q_SLOTS:
  void initTestCase() {
    writeText(folder_.filePath("sheet.json"), motionScene);
    writeText(folder_.filePath("box.obj"), strainBox);
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1200, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(window_->document().open(folder_.filePath("sheet.json")));
    run("swing");
  }
  void cleanupTestCase() { window_.reset(); }

  /// What is complete is played; Space pauses, and plays again.
  void playsAndPauses() {
    QVERIFY(view() && viewport().showsFrames());
    QVERIFY(std::abs(viewport().duration() - 0.2) < 1e-12);
    QCOMPARE(result()->frames.size(), 11u);  // at rest, and after every second of 20 steps
    QVERIFY(viewport().isPlaying());
    QAction* play = window_->actions().find(QStringLiteral("view.play"));
    QVERIFY(play->isEnabled());
    QTest::keyClick(&viewport(), Qt::Key_Space);
    QVERIFY(!viewport().isPlaying());
    QTest::keyClick(&viewport(), Qt::Key_Space);
    QVERIFY(viewport().isPlaying());
    viewport().pause();
  }

  /// The slider goes through all frames, which are where they were recorded.
  void scrubs() {
    auto* bar = window_->findChild<shell::PlaybackBar*>();
    auto* scrub = bar->findChild<QSlider*>();
    QVERIFY(bar->findChild<QComboBox*>()->currentText().contains("speed"));
    for (const int frame : {0, 4, 10}) {
      scrub->setValue(frame * scrub->maximum() / 10 + (frame % 10 ? 1 : 0));
      QCOMPARE(view()->frame(), frame);
      QVERIFY(view()->mesh().points == result()->frames[static_cast<std::size_t>(frame)]->positions);
    }
    viewport().setTime(0);
    const QImage first = viewport().grabImage();
    viewport().setTime(0.2);
    QVERIFY(viewport().grabImage() != first);
  }

  /// How near it is to its limits over time, with the instant on show; a click shows another one.
  void chartsTheMotion() {
    auto* plots = window_->sheets().findChildren<QComboBox*>()[1];
    for (QComboBox* each : window_->sheets().findChildren<QComboBox*>())
      if (each->findText("Nearness over time") >= 0) plots = each;
    plots->setCurrentText("Nearness over time");
    Q_EMIT plots->activated(plots->currentIndex());
    const plots::LineChart& chart = window_->sheets().plot()->chart();
    QCOMPARE(chart.lines.size(), 1u);  // without limits of bending
    QCOMPARE(chart.lines[0].x.size(), 20u);
    QCOMPARE(chart.lines[0].x.back(), result()->steps.back().time);
    QCOMPARE(chart.lines[0].y.back(), result()->state.stretchGauge.maxCoeff());
    Q_EMIT window_->sheets().plot()->placeChosen(0.1);
    QCOMPARE(view()->frame(), 5);
    QVERIFY(!viewport().isPlaying());
  }

  /// A triangle is read out as it is in the frame on show: its strain there is found anew from its corners.
  void readsTheFrameOnShow() {
    window_->sheets().take(3);
    viewport().setTime(0.12);
    const double gauge = result()->frames[6]->stretchGauge[3];
    QVERIFY(std::abs(gauge - result()->state.stretchGauge[3]) > 1e-3);
    QTRY_VERIFY(window_->sheets().readout().contains(QString::number(100 * gauge, 'f', 1)));
    const Eigen::Vector3d strain =
        scene::strainPlaces(scene::sheetMoment(*result(), 6), scene::SheetLimit::stretch, {3});
    const auto& [a, b, c] = result()->sheet->mesh.triangles[3];
    const Eigen::Matrix3Xd &rest = result()->sheet->mesh.points, &now = result()->frames[6]->positions;
    Eigen::Matrix2d before;
    before << (rest.col(b) - rest.col(a)).head<2>(), (rest.col(c) - rest.col(a)).head<2>();
    Eigen::Matrix<double, 3, 2> after;
    after << now.col(b) - now.col(a), now.col(c) - now.col(a);
    const Eigen::Matrix<double, 3, 2> gradient = after * before.inverse();
    const Eigen::Matrix2d green = 0.5 * (gradient.transpose() * gradient - Eigen::Matrix2d::Identity());
    QVERIFY((strain - Eigen::Vector3d(green(0, 0), green(1, 1), green(0, 1))).norm() < 1e-12);
    window_->sheets().take(-1);
  }

  /// Films look as the viewport does; frames are written as meshes and as an animation too.
  void exports() {
    base::ExecutionContext context;
    const auto exported = [&](const char* name) {
      return shell::frameExport(folder_.filePath(name), window_->session(), viewport())(context);
    };
    viewport().setClothSpeed(1);
    viewport().setTime(0.2);
    QCOMPARE(exported("film.png"), 11);
    const QImage film(folder_.filePath("film_00010.png"));
    QVERIFY(film.height() >= 720 && film != QImage(folder_.filePath("film_00004.png")));
    QCOMPARE(exported("film.ogv"), 1);
    QVERIFY(QFileInfo(folder_.filePath("film.ogv")).size() > 3000);
    QCOMPARE(exported("film.glb"), 1);
    QCOMPARE(exported("mesh.ply"), 11);
    const geometry::SurfaceMesh written = geometry::readMesh(folder_.filePath("mesh_00010.ply").toStdString(), 1);
    QCOMPARE(written.triangles.size(), result()->sheet->mesh.triangles.size());
    QVERIFY((written.points - result()->frames[10]->positions).cwiseAbs().maxCoeff() < 1e-7);  // floats
    viewport().setTime(0.08);
    shell::exportTo(folder_.filePath("shown.ply"), window_->document(), window_->session(), {}, viewport());
    const geometry::SurfaceMesh shown = geometry::readMesh(folder_.filePath("shown.ply").toStdString(), 1);
    QVERIFY((shown.points - result()->frames[4]->positions).cwiseAbs().maxCoeff() < 1e-7);
  }

  /// An equilibrium stands still: there is nothing to be played.
  void equilibriaStandStill() {
    viewport().play();
    run("press");
    QVERIFY(view() && !viewport().showsFrames() && !viewport().isPlaying());
    QVERIFY(!window_->actions().find(QStringLiteral("view.play"))->isEnabled());
    QVERIFY_EXCEPTION_THROWN(
        shell::frameExport(folder_.filePath("still.ogv"), window_->session(), viewport()), base::InputError);
  }
};

QTEST_MAIN(TestSheetMotionWindow)
#include "test_sheet_motion_window.moc"
