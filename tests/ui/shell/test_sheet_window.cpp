#include <QApplication>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/scene/macro_result.hpp"
#include "tests/core/scene/strain_box.hpp"
#include "ui/panels/sheet_panel.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using document::StudyStatus;
using panels::SheetPanel;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

/// Limits from a file, so that nothing but the sheet is computed: a box in strain space.
constexpr const char* sheetScene = R"({
  "schema_version": 1,
  "title": "A sheet",
  "interlocking_cells": [{"name": "material", "type": "threefold"}],
  "studies": [{"name": "press", "type": "macro_equilibrium", "shape": "hexagon", "radius": "40 mm", "rings": 4,
               "stretch_limits": "box.obj",
               "clamps": [{"point": ["40 mm", 0]}, {"point": ["-40 mm", 0]}],
               "loads": [{"point": [0, 0], "force": [0, 0, "-0.1 N"]}]}]
})";

}  // namespace

/// A large piece in the whole window: read out, clamped and loaded by clicks, and run as a series.
class TestSheetWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;

  SheetPanel& sheets() { return window_->sheets(); }
  document::Document& document() { return window_->document(); }
  void run() {
    window_->session().run({"press"});
    QTRY_VERIFY_WITH_TIMEOUT(document().study("press")->status == StudyStatus::solved, patience);
  }
  std::shared_ptr<const scene::MacroResult> result(const char* study = "press") {
    return std::dynamic_pointer_cast<const scene::MacroResult>(document().study(study)->result);
  }
  /// Where the viewport picks this number, searched on a grid.
  std::optional<QPointF> placeOf(int number) {
    for (int y = 4; y < window_->viewport().height(); y += 3)
      for (int x = 4; x < window_->viewport().width(); x += 3)
        if (window_->viewport().nodeAt(QPointF(x, y)) == number) return QPointF(x, y);
    return std::nullopt;
  }
  /// Where it is seen once the window has settled.
  void click(int number) {
    QTest::qWait(QApplication::doubleClickInterval() + 50);  // no double click
    const auto place = placeOf(number);
    QVERIFY(place);
    QTest::mouseClick(&window_->viewport(), Qt::LeftButton, {}, place->toPoint());
  }

 private Q_SLOTS:
  void initTestCase() {
    writeText(folder_.filePath("sheet.json"), sheetScene);
    writeText(folder_.filePath("box.obj"), strainBox);
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1200, 900);
    window_->show();
    QVERIFY(document().open(folder_.filePath("sheet.json")));
    run();
  }
  void cleanupTestCase() { window_.reset(); }

  /// The share of triangles that are nearer than a value is read off the plot; the nearest is the first.
  void plotsNearness() {
    const plots::LineChart& chart = sheets().plot()->chart();
    QCOMPARE(chart.lines.size(), 1u);
    QCOMPARE(chart.lines[0].y.size(), result()->sheet->mesh.triangles.size());
    QCOMPARE(chart.lines[0].y.front(), result()->state.stretchGauge.maxCoeff());
    QCOMPARE(chart.lines[0].y.back(), result()->state.stretchGauge.minCoeff());
    QCOMPARE(chart.lines[0].x.back(), 100.0);
  }

  /// What is shown of it is Green strain.
  void readsATriangle() {
    sheets().setClicks(SheetPanel::Clicks::read);
    Eigen::Index worst = 0;
    result()->state.stretchGauge.maxCoeff(&worst);
    click(static_cast<int>(worst));
    QCOMPARE(sheets().selectedTriangle(), std::optional(static_cast<int>(worst)));
    QVERIFY2(sheets().readout().contains(QString::number(100 * result()->state.stretchGauge[worst], 'f', 1)),
             qPrintable(sheets().readout()));
    const Eigen::Vector3d strain =
        scene::strainPlaces(scene::sheetMoment(*result()), scene::SheetLimit::stretch, {static_cast<int>(worst)});
    const auto& [a, b, c] = result()->sheet->mesh.triangles[static_cast<std::size_t>(worst)];
    const Eigen::Matrix3Xd rest = result()->sheet->mesh.points,
                           now = result()->state.positions.reshaped(3, rest.cols());
    Eigen::Matrix2d before;
    before << (rest.col(b) - rest.col(a)).head<2>(), (rest.col(c) - rest.col(a)).head<2>();
    Eigen::Matrix<double, 3, 2> after;
    after << now.col(b) - now.col(a), now.col(c) - now.col(a);
    const Eigen::Matrix<double, 3, 2> gradient = after * before.inverse();
    const Eigen::Matrix2d green = 0.5 * (gradient.transpose() * gradient - Eigen::Matrix2d::Identity());
    QVERIFY((strain - Eigen::Vector3d(green(0, 0), green(1, 1), green(0, 1))).norm() < 1e-12);
  }

  /// A click clamps a node and makes the result stale, another one frees it; both are undone.
  void clampsByClicks() {
    sheets().setClicks(SheetPanel::Clicks::clamp);
    const auto clampCount = [&] { return document().valueAt("/studies/0/clamps").size(); };
    const int node = result()->loaded.at(0);
    const std::size_t before = clampCount();
    click(node);
    QCOMPARE(clampCount(), before + 1);
    QVERIFY(document().study("press")->stale);
    click(node);
    QCOMPARE(clampCount(), before);
    document().undoStack().undo();
    QCOMPARE(clampCount(), before + 1);
    document().undoStack().undo();
    QCOMPARE(clampCount(), before);
    QVERIFY(!document().study("press")->stale);
  }

  /// A load goes where the click was, with the force that is set, and counts in the next run.
  void loadsByClicks() {
    sheets().setClicks(SheetPanel::Clicks::load);
    const int freed = result()->loaded.at(0);
    click(freed);
    QVERIFY(document().valueAt("/studies/0/loads").empty());
    const double before = scene::largestDeflection(*result());
    int other = -1;
    for (int node = 0; node < result()->sheet->mesh.points.cols() && other < 0; ++node)
      if (node != freed &&
          std::find(result()->clamped.begin(), result()->clamped.end(), node) == result()->clamped.end() &&
          placeOf(node))
        other = node;
    QVERIFY(other >= 0);
    click(other);
    QCOMPARE(document().valueAt("/studies/0/loads").size(), 1u);
    run();
    QCOMPARE(result()->loaded, std::vector<int>{other});
    QVERIFY(result()->deflections(2, 0) < 0);
    QVERIFY(std::abs(before - scene::largestDeflection(*result())) > 1e-6);
  }

  /// One click makes the study of refinement; undoing it takes both sheets away.
  void runsASeries() {
    sheets().setStudy("press");
    sheets().addFamily(SheetPanel::Family::refinement);
    QCOMPARE(document().studies().size(), 3u);
    for (const char* study : {"press", "press 4x triangles", "press 16x triangles"})
      QTRY_VERIFY_WITH_TIMEOUT(document().study(study)->status == StudyStatus::solved, patience);
    const auto triangles = [&](const char* study) { return result(study)->sheet->mesh.triangles.size(); };
    QCOMPARE(triangles("press 4x triangles"), 4 * triangles("press"));
    QCOMPARE(triangles("press 16x triangles"), 16 * triangles("press"));
    QTRY_COMPARE(sheets().plot()->chart().lines.size(), 1u);
    QTRY_COMPARE(sheets().plot()->chart().lines[0].x.size(), 3u);
    sheets().setStudy("press");
    sheets().addFamily(SheetPanel::Family::refinement);  // they are there
    QCOMPARE(document().studies().size(), 3u);
    document().undoStack().undo();
    QCOMPARE(document().studies().size(), 1u);
  }
};

QTEST_MAIN(TestSheetWindow)
#include "test_sheet_window.moc"
