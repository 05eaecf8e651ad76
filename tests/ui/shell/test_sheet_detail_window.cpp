#include <QComboBox>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "core/scene/macro_result.hpp"
#include "tests/core/scene/strain_box.hpp"
#include "ui/panels/sheet_panel.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/shell/exporter.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using document::StudyStatus;
using panels::SheetOutline;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

constexpr const char* detailScene = R"({
  "schema_version": 1,
  "title": "A sheet and its elements",
  "interlocking_cells": [{"name": "material", "type": "threefold"}],
  "studies": [
    {"name": "press", "type": "macro_equilibrium", "shape": "hexagon", "radius": "29 mm", "rings": 4, "native": true,
     "load_steps": 3, "stretch_limits": "box.obj", "clamps": [{"point": ["29 mm", 0]}, {"point": ["-29 mm", 0]}],
     "loads": [{"point": [0, 0], "force": [0, 0, "-0.4 N"]}]},
    {"name": "place", "type": "macro_equilibrium", "shape": "hexagon", "radius": "29 mm", "rings": 4, "elements": true,
     "stretch_limits": "box.obj", "gravity": [0, 0, 0], "clamps": [{"point": ["29 mm", 0]}, {"point": ["-29 mm", 0]}],
     "loads": [{"point": [0, 0], "force": [0, 0, "-1 mN"]}]}]
})";

/// A third of a turn of a triangle around the origin, in millimetres.
constexpr const char* outlineFile = "x [mm],y [mm]\n30,0\n-15,26\n-15,-26\n";

}  // namespace

/// Elements beside a sheet and in its place, and the outline of the piece, in the whole window.
class TestSheetDetailWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;

  viewport::Viewport& viewport() { return window_->viewport(); }
  panels::SheetPanel& sheets() { return window_->sheets(); }
  document::Document& document() { return window_->document(); }
  std::shared_ptr<render::MacroView> view() { return std::dynamic_pointer_cast<render::MacroView>(viewport().guest()); }
  std::shared_ptr<const scene::MacroResult> result(const char* study) {
    return std::dynamic_pointer_cast<const scene::MacroResult>(document().study(study)->result);
  }
  void run(const char* study) {
    window_->session().run({study});
    QTRY_VERIFY_WITH_TIMEOUT(document().study(study)->status == StudyStatus::solved, patience);
    viewport().pause();
  }
  QImage half(bool right) {
    const QImage whole = viewport().grabImage();
    return whole.copy(right ? whole.width() / 2 + 2 : 0, 0, whole.width() / 2 - 2, whole.height());
  }
  void choose(const char* entry) {
    for (QComboBox* each : sheets().findChildren<QComboBox*>())
      if (each->findText(entry) >= 0) {
        each->setCurrentText(entry);
        Q_EMIT each->activated(each->currentIndex());
      }
  }

 private Q_SLOTS:
  void initTestCase() {
    writeText(folder_.filePath("sheet.json"), detailScene);
    writeText(folder_.filePath("box.obj"), strainBox);
    writeText(folder_.filePath("triangle.csv"), outlineFile);
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1200, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(document().open(folder_.filePath("sheet.json")));
  }
  void cleanupTestCase() { window_.reset(); }

  /// Both halves show the same part of the loads, and are seen by one camera.
  void elementsMoveBesideTheirSheet() {
    run("press");
    QVERIFY(view()->nativeVisible());
    QVERIFY(viewport().showsFrames() && viewport().frameClock() == render::FrameClock::loads);
    QCOMPARE(viewport().duration(), 1.0);
    viewport().setTime(0.4);
    QCOMPARE(view()->frame(), 1);
    QVERIFY(view()->mesh().points == result("press")->frames[1]->positions);
    const QImage sheet = half(false), elements = half(true);
    viewport().setTime(1);
    QVERIFY(half(false) != sheet);
    QVERIFY(half(true) != elements);
    viewport().setTime(0.4);
    QVERIFY(half(true) == elements);
    view()->orbit(0.1, 0);
    viewport().redrawGuest();
    QVERIFY(half(true) != elements && half(false) != sheet);
    // A click among the elements reads no triangle of the sheet.
    const Eigen::Vector2d pixel = view()->trianglePixels().col(40);
    const QPointF place = QPointF(pixel.x(), pixel.y()) / viewport().devicePixelRatioF();
    QCOMPARE(viewport().nodeAt(place), std::optional(40));
    QVERIFY(!viewport().nodeAt(place + QPointF(0.5 * viewport().width(), 0)));
  }

  /// Without them the sheet has the viewport to itself, also in films.
  void elementsAreHidden() {
    viewport().fit();
    QToolButton* button = nullptr;
    for (QToolButton* each : sheets().findChildren<QToolButton*>())
      if (each->text() == QLatin1String("Native")) button = each;
    QVERIFY(button && button->isVisibleTo(&sheets()));
    base::ExecutionContext context;
    const auto filmed = [&](const char* name) {
      const int files = shell::frameExport(folder_.filePath(name), window_->session(), viewport())(context);
      return files > 0 ? QImage(folder_.filePath(QString(name).replace(".png", "_00000.png"))) : QImage();
    };
    const QImage both = filmed("both.png");
    button->click();
    QVERIFY(!view()->nativeVisible());
    const QImage alone = filmed("alone.png");
    QVERIFY(!both.isNull() && both.size() == alone.size() && both != alone);
    button->click();
    QVERIFY(view()->nativeVisible());
    QVERIFY(filmed("both.png") == both);
  }

  /// The elements stand in place of the sheet where they have been placed, and only there.
  void elementsStandInPlaceOfTheSheet() {
    run("place");
    QVERIFY(result("place")->placed && !view()->nativeVisible());
    const QImage sheet = viewport().grabImage();
    choose("Elements");
    QVERIFY(view()->elementsVisible());
    const QImage elements = viewport().grabImage();
    QVERIFY(elements != sheet);
    // A still picture has what was seen before the camera went away and came back.
    const render::CameraPose pose = view()->cameraPose();
    QTest::mousePress(&viewport(), Qt::LeftButton, {}, QPoint(200, 200));
    QTest::mouseMove(&viewport(), QPoint(260, 230));
    QTest::mouseRelease(&viewport(), Qt::LeftButton, {}, QPoint(260, 230));
    view()->setCameraPose(pose);
    viewport().redrawGuest();
    QVERIFY(viewport().grabImage() == elements);
    choose("Nearest limit");
    QVERIFY(!view()->elementsVisible());
    QVERIFY(viewport().grabImage() == sheet);
  }

  /// A stroke gives triangles another material, as one undo step, and counts in the next run; with Ctrl it wipes.
  void materialsArePainted() {
    sheets().setStudy("press");
    run("press");
    const auto before = document().scene().json();
    const QImage field = viewport().grabImage();
    sheets().setClicks(panels::SheetPanel::Clicks::paint);
    QVERIFY(sheets().canPaint());
    viewport().setAxisView(render::AxisView::top);
    const QImage materials = viewport().grabImage();
    QVERIFY(materials != field);
    const Eigen::Matrix2Xd pixels = view()->trianglePixels();
    const auto placeOf = [&](int triangle) { return QPoint(int(pixels(0, triangle)), int(pixels(1, triangle))); };
    constexpr int first = 20, last = 70;
    QCOMPARE(view()->triangleAt(placeOf(first).x(), placeOf(first).y()), std::optional(first));
    const auto stroke = [&](int from, int to, Qt::KeyboardModifiers keys) {
      QTest::mousePress(&viewport(), Qt::LeftButton, keys, placeOf(from));
      QTest::mouseMove(&viewport(), placeOf(to));
      QTest::mouseRelease(&viewport(), Qt::LeftButton, keys, placeOf(to));
    };
    stroke(first, last, {});
    const auto painted = [&] { return document().valueAt("/studies/0/regions/0/triangles").get<std::vector<int>>(); };
    const auto has = [&](int triangle) { return std::ranges::count(painted(), triangle) == 1; };
    QVERIFY(document().study("press")->stale && has(first) && has(last));
    const std::size_t count = painted().size();
    QVERIFY(count > 2 && count < 60);
    QVERIFY(viewport().grabImage() != materials);
    document().undoStack().undo();
    QVERIFY(document().scene().json() == before);
    document().undoStack().redo();
    stroke(first, first, Qt::ControlModifier);
    QVERIFY(!has(first) && has(last) && painted().size() < count);
    QVERIFY(document().valueAt("/studies/0/regions").size() == 1);
    run("press");
    const interlock::MacroSheet& sheet = *result("press")->sheet;
    QCOMPARE(sheet.materialOf[last], 1);
    QCOMPARE(sheet.materialOf[first], 0);
    QVERIFY(std::abs(sheet.angleOf[last] - M_PI / 2) < 1e-12 && sheet.angleOf[first] == 0);
    QVERIFY(!result("press")->native);
    // Another outline has other triangles.
    sheets().setOutline(SheetOutline::disk);
    QVERIFY(!sheets().canPaint());
    sheets().setClicks(panels::SheetPanel::Clicks::read);
  }

  /// Another outline is as far across, is one undo step, and is what runs.
  void outlinesAreChosen() {
    sheets().setStudy("place");
    const auto before = document().scene().json();
    sheets().setOutline(SheetOutline::square);
    QVERIFY(document().study("place")->stale);
    QVERIFY(document().valueAt("/studies/1/shape") == "rectangle");
    QCOMPARE(document().valueAt("/studies/1/size/0").get<double>(), 0.058);
    sheets().setOutline(SheetOutline::disk);
    QCOMPARE(document().valueAt("/studies/1/radius").get<double>(), 0.029);
    QCOMPARE(document().valueAt("/studies/1/rings").get<int>(), 4);  // as it was at first
    document().undoStack().undo();
    document().undoStack().undo();
    QVERIFY(document().scene().json() == before);
    sheets().setOutlineFrom(folder_.filePath("triangle.csv"));
    QVERIFY(document().valueAt("/studies/1/outline") == "triangle.csv");
    document().setValue("/studies/1/elements", false, "no elements");
    run("place");
    const Eigen::Matrix3Xd& points = result("place")->sheet->mesh.points;
    QVERIFY(std::abs(points.row(0).maxCoeff() - 0.03) < 1e-9 && std::abs(points.row(1).minCoeff() + 0.026) < 1e-9);
    sheets().setOutline(SheetOutline::hexagon);  // how far a file's outline is across is known by now
    QVERIFY(std::abs(document().valueAt("/studies/1/radius").get<double>() - 0.026) < 1e-9);
  }
};

QTEST_MAIN(TestSheetDetailWindow)
#include "test_sheet_detail_window.moc"
