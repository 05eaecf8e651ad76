#include <QAction>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/geometry/closed_mesh.hpp"
#include "ui/panels/design_panel.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using scene::Json;
using shell::MainWindow;

namespace {

constexpr int patience = 300'000;  // milliseconds

}  // namespace

/// Designs, from the window.
class TestDesignWindow : public QObject {
  Q_OBJECT

  Json mass() { return window_->document().valueAt("/point_masses/0/mass"); }

 private Q_SLOTS:
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
  }
  void cleanup() { window_.reset(); }

  /// A mass is dragged, the motion foretold and solved anew; a larger swing is asked for and taken; all of it is undone
  /// and done again; and what came of it is exported and read back.
  void fromADragToAPrintedDesign() {
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/three_link.json")));
    panels::DesignPanel& panel = window_->design();
    jobs::MotionSession& session = window_->session();
    QVERIFY(panels::DesignPanel::hasDesign(window_->document()));
    QVERIFY(panel.runButton()->isEnabled());
    const Json first = mass();

    session.run({"walk"});
    QTRY_VERIFY_WITH_TIMEOUT(session.shown() && session.shown()->sensitivity, patience);
    QVERIFY(window_->document().setValue("/point_masses/0/mass", 1.3 * first.get<double>(), "Drag", 1));
    QTRY_VERIFY_WITH_TIMEOUT(session.prediction().has_value(), patience);
    QVERIFY(session.isStale());
    session.update();
    QTRY_VERIFY_WITH_TIMEOUT(!session.isStale() && !session.prediction(), patience);
    const Json dragged = mass();
    QVERIFY(dragged != first);

    panel.runButton()->click();
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("design")->status == document::StudyStatus::solved, patience);
    const auto result =
        std::dynamic_pointer_cast<const scene::DesignResult>(window_->document().study("design")->result);
    const int last = static_cast<int>(result->design.history.size()) - 1;
    QVERIFY(last > 1);
    QCOMPARE(panel.shownDesign(), last);
    QCOMPARE(panel.plot()->chart().lines.at(0).x.size(), result->design.history.size());
    QCOMPARE(panel.table()->rowCount(), static_cast<int>(result->parameters.size()));
    panel.slider()->setValue(0);
    QCOMPARE(panel.shownDesign(), 0);
    QVERIFY(panel.summary().contains(QStringLiteral("×1.00")));
    panel.slider()->setValue(last);
    QVERIFY(!panel.summary().contains(QStringLiteral("×1.00")));

    const int step = window_->document().undoStack().index();
    panel.take()->click();
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().undoStack().index() == step + 1, patience);
    const Json taken = mass();
    QVERIFY(taken != dragged);
    while (window_->document().undoStack().canUndo()) window_->document().undoStack().undo();
    QVERIFY(mass() == first);
    while (window_->document().undoStack().canRedo()) window_->document().undoStack().redo();
    QVERIFY(mass() == taken);

    const QString file = folder_.filePath("links.stl");
    window_->exportPartsTo(file);
    QTRY_VERIFY_WITH_TIMEOUT(window_->messages().sentence().contains("Exported to"), patience);
    const auto mesh = geometry::weldMesh(geometry::readMesh(file.toStdString(), 1e-3), 1e-8);
    QVERIFY(geometry::enclosedVolume(mesh) > 0);
  }

 private:
  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestDesignWindow)
#include "test_design_window.moc"
