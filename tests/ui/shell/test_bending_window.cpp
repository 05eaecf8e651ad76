#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QFileInfo>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/scene/bending_result.hpp"
#include "ui/panels/boundary_panel.hpp"
#include "ui/panels/cell_test_panel.hpp"
#include "ui/panels/print_panel.hpp"
#include "ui/panels/size_panel.hpp"
#include "ui/panels/travel_panel.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/polar_plot.hpp"
#include "ui/render/patch_view.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using document::StudyStatus;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

/// Of seven elements.
constexpr const char* thickScene = R"({
  "schema_version": 1,
  "title": "Thick",
  "interlocking_cells": [{"name": "thick", "type": "threefold", "ring_radius": "5.2 mm", "wire_radius": "1.6 mm",
                          "distance": "5 mm", "lean": "50 deg", "spacing": "13.5 mm"}],
  "studies": [
    {"name": "bend", "type": "bending_test", "radius": "14 mm", "trials": 1},
    {"name": "hang", "type": "gravity_bending", "size": ["60 mm", "5 mm"]},
    {"name": "limits", "type": "curvature_limits", "radius": "14 mm", "directions": 6, "trials": 1, "final_gap": 0.05},
    {"name": "travel", "type": "free_travel", "directions": 36},
    {"name": "size", "type": "bending_size", "radii": ["14 mm"], "trials": 1, "final_gap": 0.05},
    {"name": "boundary", "type": "bending_boundary", "radius": "14 mm", "subdivisions": 0, "trials": 1,
     "test_star_shape": false, "final_gap": 0.05}
  ]
})";

/// Values that are known, of all curves.
int knownCount(const scene::PolarCurves& curves) {
  int count = 0;
  for (const scene::PolarCurve& curve : curves.curves)
    for (const double value : curve.values) count += std::isfinite(value);
  return count;
}

}  // namespace

/// Finite patches in the whole window: bent, hanging, their limits, and printed.
class TestBendingWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;

  StudyStatus status(const char* study) const { return window_->document().study(study)->status; }
  const render::PatchView* patch() const {
    return dynamic_cast<const render::PatchView*>(window_->viewport().guest().get());
  }
  void run(const char* study) {
    window_->session().run({study});
    QTRY_VERIFY_WITH_TIMEOUT(status(study) == StudyStatus::solved, patience);
  }
  QWidget* shownDock(const char* name) const { return window_->findChild<QDockWidget*>(QLatin1String(name)); }

 private Q_SLOTS:
  void initTestCase() {
    QFile file(folder_.filePath("thick.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(thickScene);
  }
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(window_->document().open(folder_.filePath("thick.json")));
  }
  void cleanup() { window_.reset(); }

  /// The patch is shown as it locks, with its numbers; the table tells them too.
  void aPatchIsBentAndHung() {
    run("bend");
    QTRY_VERIFY_WITH_TIMEOUT(patch() != nullptr, patience);
    QCOMPARE(patch()->configuration()->state.rotations.size(), std::size_t(7));
    QVERIFY(patch()->configuration()->curvature.has_value() && patch()->markCount() > 0);
    const std::string caption = patch()->caption();
    for (const char* text : {"bend:", " 1/m at 0°", "radius", "mean gap", "7 elements"})
      QVERIFY2(caption.find(text) != std::string::npos, caption.c_str());
    QTableWidget* table = window_->cellTests().table();
    QCOMPARE(table->rowCount(), 3);
    QVERIFY2(table->item(1, 2)->text().endsWith("1/m"), qPrintable(table->item(1, 2)->text()));
    run("hang");
    QTRY_VERIFY_WITH_TIMEOUT(patch()->configuration()->gravity.has_value(), patience);
    QCOMPARE(patch()->configuration()->clamped.size(), std::size_t(1));
    QVERIFY(patch()->caption().find("1 elements clamped") != std::string::npos ||
            patch()->caption().find("1 element clamped") != std::string::npos);
    table->setCurrentCell(1, 0);
    QTRY_VERIFY_WITH_TIMEOUT(patch()->configuration()->curvature.has_value(), patience);
    // Another gap: what is shown is marked as old.
    window_->document().setValue("/studies/0/final_gap", 0.002, "gap");
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("bend")->stale, patience);
    table->setCurrentCell(0, 0);
    QVERIFY(!patch());
  }

  /// Curves grow while the study runs; cancelled, what there is stays.
  void curvesFillIn() {
    for (const char* study : {"travel", "limits"}) {
      QVERIFY(window_->document().open(folder_.filePath("thick.json")));
      panels::TravelPanel& panel = window_->travel();
      int least = 1 << 30, most = 0, looks = 0;
      QObject watcher;
      connect(&window_->document(), &document::Document::studyChanged, &watcher, [&](const std::string& name) {
        if (name != study || panel.study() != study || panel.plot()->curves().curves.empty()) return;
        const int known = knownCount(panel.plot()->curves());
        least = std::min(least, known);
        looks += known < most;
        most = std::max(most, known);
        if (known >= 4 && status(study) == StudyStatus::running) window_->actions().find("study.cancel")->trigger();
      });
      window_->session().run({study});
      QTRY_VERIFY_WITH_TIMEOUT(status(study) == StudyStatus::cancelled, patience);
      QCOMPARE(looks, 0);
      const int kept = knownCount(panel.plot()->curves());
      const int all = study == std::string("travel") ? 3 * 36 : 4 * 6;
      QVERIFY2(kept >= 4 && kept < all && least < kept, qPrintable(QString("%1 %2").arg(least).arg(kept)));
    }
  }

  void sizesArePlotted() {
    QVERIFY(window_->sizes().plot()->chart().lines.empty());
    run("size");
    const auto& chart = window_->sizes().plot()->chart();
    QCOMPARE(chart.lines.size(), std::size_t(5));
    const auto result =
        std::dynamic_pointer_cast<const scene::BendingSizeResult>(window_->document().study("size")->result);
    QCOMPARE(chart.lines[0].x[0], 14.0);
    QCOMPARE(chart.lines[0].y[0], std::abs(result->sizes[0].limits[0].curvature));
    window_->sizes().exportTo(folder_.filePath("sizes.csv"));
    QVERIFY(QFileInfo(folder_.filePath("sizes.csv")).size() > 50);
  }

  /// The surface lies in curvature space; a click shows the patch that locks there.
  void theBendingBoundaryIsExamined() {
    panels::BoundaryPanel& panel = window_->boundary();
    run("boundary");
    QVERIFY(panel.surface() != nullptr);
    QCOMPARE(panel.surface()->space.unit, std::string("1/m"));
    QCOMPARE(panel.surface()->knownCount(), 12);
    for (const QComboBox* combo : panel.findChildren<QComboBox*>())
      if (combo->accessibleName() == "Slice") QCOMPARE(combo->itemText(3), QString("k_xy = const"));
    panel.viewport().setAxisView(render::AxisView::top);
    Eigen::Index highest = 0;
    panel.surface()->points.row(2).maxCoeff(&highest);
    panel.viewport().grabImage();
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (int state = 0; state < 12; ++state) middle += panel.view().pixelOf(state).value() / 12;
    const QPoint place(static_cast<int>(std::lround(middle.x())), static_cast<int>(std::lround(middle.y())));
    QTest::mouseMove(&panel.viewport(), place);
    QTRY_VERIFY_WITH_TIMEOUT(panel.readout().contains("k_xx") && panel.readout().contains("1/m"), patience);
    panel.examine(static_cast<int>(highest));
    QTRY_VERIFY_WITH_TIMEOUT(patch() != nullptr, patience);
    const auto& state = panel.result()->boundary.states[static_cast<std::size_t>(highest)];
    QVERIFY(patch()->configuration()->state.positions == state.cell.positions);
    QVERIFY(patch()->markCount() > 0);
    for (const char* name : {"b.png", "b.ply", "b.csv"}) {
      window_->exportBoundaryTo(folder_.filePath(name));
      QVERIFY2(QFileInfo(folder_.filePath(name)).size() > 500, name);
    }
    panel.examine(-1);
    QVERIFY(!patch());
  }

  /// What is chosen is told before it is written.
  void aPatchIsPrinted() {
    window_->actions().find("model.print")->trigger();
    panels::PrintPanel& panel = window_->print();
    QTRY_VERIFY_WITH_TIMEOUT(panel.isVisible(), patience);
    panel.choose(2, 32, 0);
    QTRY_VERIFY_WITH_TIMEOUT(panel.isReady(), patience);
    QVERIFY2(panel.findings().startsWith("7 elements") && panel.findings().contains("clearance"),
             qPrintable(panel.findings()));
    QCOMPARE(panel.request().outline, std::string("32.0 mm"));
    panel.choose(0, 2, 2);
    QTRY_VERIFY2(panel.isReady() && panel.findings().startsWith("4 elements"), qPrintable(panel.findings()));
    window_->exportPatchTo(folder_.filePath("patch.stl"));
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo::exists(folder_.filePath("patch.stl")), patience);
    QVERIFY(QFileInfo(folder_.filePath("patch.stl")).size() > 100'000);
    // Nothing inside: no button, but a sentence.
    panel.choose(2, 1, 0);
    QTRY_VERIFY_WITH_TIMEOUT(!panel.findings().isEmpty(), patience);
    // Cancelled: no file.
    panel.choose(0, 30, 30);
    QTRY_VERIFY_WITH_TIMEOUT(panel.isReady(), patience);
    window_->exportPatchTo(folder_.filePath("large.stl"));
    window_->actions().find("study.cancel")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!window_->actions().find("study.cancel")->isEnabled(), patience);
    QVERIFY(!QFileInfo::exists(folder_.filePath("large.stl")));
  }
};

QTEST_MAIN(TestBendingWindow)
#include "test_bending_window.moc"
