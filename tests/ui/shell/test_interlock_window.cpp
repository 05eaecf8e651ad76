#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFile>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "ui/panels/boundary_panel.hpp"
#include "ui/panels/cell_test_panel.hpp"
#include "ui/panels/travel_panel.hpp"
#include "ui/plots/polar_plot.hpp"
#include "ui/render/limit_view.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using document::StudyStatus;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

constexpr const char* netScene = R"({
  "schema_version": 1,
  "title": "Net",
  "interlocking_cells": [{"name": "net", "type": "ring_net", "ring_radius": "4 mm", "wire_radius": "0.6 mm",
                          "spacing": "12 mm"}],
  "studies": [
    {"name": "stretch", "type": "cell_test", "cell": "net", "direction": "90 deg"},
    {"name": "travel", "type": "free_travel", "cell": "net", "directions": 6},
    {"name": "boundary", "type": "stretch_boundary", "cell": "net", "subdivisions": 1, "test_star_shape": false},
    {"name": "long", "type": "stretch_boundary", "cell": "net", "subdivisions": 2, "use_symmetries": false,
     "test_star_shape": false}
  ]
})";

}  // namespace

/// Interlocking materials in the whole window.
class TestInterlockWindow : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;

  bool hasDock(const char* name) const {
    const auto* dock = window_->findChild<QDockWidget*>(QLatin1String(name));
    return dock && !dock->isHidden();
  }
  StudyStatus status(const char* study) const { return window_->document().study(study)->status; }
  const render::LimitView* limit() const {
    return dynamic_cast<const render::LimitView*>(window_->viewport().guest().get());
  }
  void run(const char* study) {
    window_->session().run({study});
    QTRY_VERIFY_WITH_TIMEOUT(status(study) == StudyStatus::solved, patience);
  }

 private Q_SLOTS:
  void initTestCase() {
    QFile file(folder_.filePath("net.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(netScene);
  }
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(window_->document().open(folder_.filePath("net.json")));
  }
  void cleanup() { window_.reset(); }

  void docksFitTheScene() {
    QVERIFY(hasDock("boundary") && hasDock("travel") && hasDock("cell_tests") && !hasDock("response"));
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!hasDock("boundary") && !hasDock("travel") && !hasDock("cell_tests") && hasDock("response"));
  }

  /// A limit of the surface is clicked, and the very elements lock.
  void aBoundaryIsExamined() {
    panels::BoundaryPanel& panel = window_->boundary();
    QVERIFY(!panel.surface());
    run("boundary");
    QVERIFY(panel.surface() != nullptr);
    QCOMPARE(panel.study(), std::string("boundary"));
    QCOMPARE(panel.surface()->knownCount(), 42);
    QVERIFY(panel.view().caption().find("42 limits") != std::string::npos);
    // The click goes to the limit that is seen there.
    panel.viewport().setAxisView(render::AxisView::top);
    Eigen::Index highest = 0;
    panel.surface()->points.row(2).maxCoeff(&highest);
    panel.viewport().grabImage();
    const auto pixel = panel.view().pixelOf(static_cast<int>(highest));
    QVERIFY(pixel.has_value());
    const QPoint place(static_cast<int>(std::lround(pixel->x())), static_cast<int>(std::lround(pixel->y())));
    QTest::mouseMove(&panel.viewport(), place);
    QTRY_VERIFY_WITH_TIMEOUT(panel.readout().contains(QStringLiteral("Limit %1:").arg(highest)), patience);
    QVERIFY(panel.readout().contains("touching") && panel.readout().contains("E_xy"));
    QVERIFY(!window_->viewport().guest());
    QTest::mouseClick(&panel.viewport(), Qt::LeftButton, {}, place);
    QTRY_VERIFY_WITH_TIMEOUT(limit() != nullptr, patience);
    QVERIFY(panel.view().selected() == static_cast<int>(highest));
    const auto& state = panel.result()->boundary.states[static_cast<std::size_t>(highest)];
    QVERIFY(limit()->configuration()->state.strain == state.cell.strain);
    QVERIFY(limit()->markCount() > 0);
    QVERIFY(limit()->caption().find("limit " + std::to_string(highest)) != std::string::npos);
    // Beside the surface: the material at rest again.
    QTest::mouseClick(&panel.viewport(), Qt::LeftButton, {}, QPoint(3, panel.viewport().height() - 3));
    QVERIFY(!limit() && !panel.view().selected());
    // Another scene has none of this any more.
    panel.examine(3);
    QTRY_VERIFY_WITH_TIMEOUT(limit() != nullptr, patience);
    QVERIFY(window_->document().open(folder_.filePath("net.json")));
    QVERIFY(!limit() && !panel.surface());
  }

  void controlsChangeThePicture() {
    panels::BoundaryPanel& panel = window_->boundary();
    run("boundary");
    const auto combos = panel.findChildren<QComboBox*>();
    const auto named = [&](const char* name) {
      for (QComboBox* combo : combos)
        if (combo->accessibleName() == QLatin1String(name)) return combo;
      return static_cast<QComboBox*>(nullptr);
    };
    named("Slice")->setCurrentIndex(3);
    Q_EMIT named("Slice")->activated(3);
    QVERIFY(panel.view().style().sliceAxis == 2);
    for (QDoubleSpinBox* box : panel.findChildren<QDoubleSpinBox*>()) box->setValue(1.5);
    QVERIFY(std::abs(panel.view().style().slicePosition - 0.015) < 1e-12);
    named("Colour")->setCurrentIndex(named("Colour")->findData("contacts"));
    Q_EMIT named("Colour")->activated(0);
    QCOMPARE(panel.view().style().quantity, std::string("contacts"));
    // Over it another one: of the document, and from disk.
    window_->document().study("boundary")->result->write(folder_.filePath("kept").toStdString());
    panel.compareWithFile(folder_.filePath("kept/boundary.ply"));
    QTRY_VERIFY_WITH_TIMEOUT(panel.compared() != nullptr, patience);
    QCOMPARE(panel.compared()->knownCount(), 42);
    QCOMPARE(named("Compare")->currentText(), QString("boundary of net"));
    panel.compareWithStudy("");
    QVERIFY(!panel.compared());
    int warnings = 0;
    connect(&window_->document(), &document::Document::messageRaised, this, [&] { ++warnings; });
    panel.compareWithFile(folder_.filePath("nothing.ply"));
    QTRY_COMPARE_WITH_TIMEOUT(warnings, 1, patience);
    disconnect(&window_->document(), nullptr, this, nullptr);
    for (const char* name : {"b.png", "b.ply", "b.csv"}) {
      window_->exportBoundaryTo(folder_.filePath(name));
      QVERIFY2(QFileInfo(folder_.filePath(name)).size() > 1000, name);
    }
  }

  /// While it runs limits come in; cancelled, what there is stays; run again, it goes on.
  void aBoundaryFillsIn() {
    panels::BoundaryPanel& panel = window_->boundary();
    int most = 0, looks = 0;
    QObject watcher;
    connect(&window_->document(), &document::Document::studyChanged, &watcher, [&](const std::string& name) {
      if (name != "long" || !panel.surface() || panel.study() != "long") return;
      const int known = panel.surface()->knownCount();
      if (known < most) ++looks;
      most = std::max(most, known);
      if (known >= 30 && status("long") == StudyStatus::running) window_->actions().find("study.cancel")->trigger();
    });
    window_->session().run({"long"});
    QTRY_VERIFY_WITH_TIMEOUT(status("long") == StudyStatus::cancelled, patience);
    QCOMPARE(looks, 0);
    const int kept = panel.surface()->knownCount();
    QVERIFY2(kept >= 30 && kept < 162, qPrintable(QString::number(kept)));
    QVERIFY(panel.view().caption().find("goes on") != std::string::npos);
    disconnect(&window_->document(), nullptr, &watcher, nullptr);
    run("long");
    QVERIFY(panel.result()->recalled >= kept);
    QCOMPARE(panel.surface()->knownCount(), 162);
  }

  void limitsOfDirectionsAreShown() {
    QTableWidget* table = window_->cellTests().table();
    QCOMPARE(table->rowCount(), 2);  // at rest, and the one test
    run("stretch");
    QTRY_VERIFY_WITH_TIMEOUT(limit() != nullptr, patience);
    const std::string caption = limit()->caption();
    QVERIFY(caption.find("+13.33 % at 90°") != std::string::npos);  // 4 (R - r) / spacing - 1
    QVERIFY(caption.find("held at") != std::string::npos && caption.find("any number of cells") != std::string::npos);
    QVERIFY(limit()->markCount() > 0);
    QVERIFY2(table->item(1, 2)->text().startsWith("+13.33"), qPrintable(table->item(1, 2)->text()));
    table->setCurrentCell(0, 0);
    QVERIFY(!limit());
    table->setCurrentCell(1, 0);
    QVERIFY(limit() != nullptr);
    window_->actions().find("cell.reset")->trigger();
    QVERIFY(!limit());
  }

  void freeTravelIsPlotted() {
    panels::TravelPanel& panel = window_->travel();
    run("travel");
    const auto& curves = panel.plot()->curves().curves;
    QCOMPARE(curves.size(), std::size_t(3));
    QCOMPARE(curves[0].angles.size(), std::size_t(6));
    // The net is the same along both of its axes.
    QVERIFY(std::abs(curves[0].values[0] - curves[0].values[3]) < 1e-4);
    QFile file(folder_.filePath("measured.csv"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("angle [deg],stretch [%],error\n0,13,1\n");
    file.close();
    panel.importMeasured(file.fileName());
    QCOMPARE(panel.plot()->measured().size(), std::size_t(1));
  }
};

QTEST_MAIN(TestInterlockWindow)
#include "test_interlock_window.moc"
