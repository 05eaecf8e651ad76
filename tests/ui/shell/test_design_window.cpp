#include <QAction>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/geometry/closed_mesh.hpp"
#include "ui/panels/design_panel.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/render/motion_pair.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using scene::Json;
using shell::MainWindow;

namespace {

constexpr int patience = 300'000;  // milliseconds

QString number(double value) { return QString::number(value, 'g', 4); }

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

    QSignalSpy progress(&panel, &panels::DesignPanel::progressMade);
    panel.runButton()->click();
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("design")->status == document::StudyStatus::solved, patience);
    const auto result =
        std::dynamic_pointer_cast<const scene::DesignResult>(window_->document().study("design")->result);
    const int last = static_cast<int>(result->design.history.size()) - 1;
    QVERIFY(last > 1);
    QCOMPARE(panel.shownDesign(), last);
    QCOMPARE(panel.plot()->chart().lines.at(0).x.size(), result->design.history.size());
    QCOMPARE(panel.table()->rowCount(), static_cast<int>(result->parameters.size()));
    // Every better design was seen as it came, as a ghost over the first, and the best one stays there.
    QVERIFY(progress.count() > 1);
    for (int i = 1; i < progress.count(); ++i) {
      const auto begun = progress.at(i).at(0).value<panels::DesignMotion>();
      QVERIFY(begun.problem == progress.at(0).at(0).value<panels::DesignMotion>().problem);
      QVERIFY(begun.z == result->before().z);
    }
    QVERIFY(progress.last().at(1).value<panels::DesignMotion>().z == result->after().z);
    viewport::Viewport& viewport = window_->viewport();
    QVERIFY(viewport.motionView().showsGhost());
    panel.slider()->setValue(0);
    QCOMPARE(panel.shownDesign(), 0);
    QVERIFY(!viewport.motionView().showsGhost());
    QVERIFY(panel.summary().contains(QStringLiteral("×1.00")));
    panel.slider()->setValue(last);
    QVERIFY(!panel.summary().contains(QStringLiteral("×1.00")));

    // Any two, side by side and in step.
    QVERIFY(!viewport.pair());
    panel.compareButton()->click();
    QVERIFY(viewport.pair() && viewport.isPlaying());
    QCOMPARE(panel.comparedDesign()->value(), 0);
    QVERIFY(QString::fromStdString(viewport.motionView().caption()).contains(number(result->before().objective)));
    QVERIFY(QString::fromStdString(viewport.pair()->right().caption()).contains(number(result->after().objective)));
    const double tau = viewport.tau();
    QTRY_VERIFY(viewport.tau() != tau);
    QCOMPARE(viewport.pair()->right().tau(), viewport.tau());
    panel.comparedDesign()->setValue(1);
    QVERIFY(
        QString::fromStdString(viewport.motionView().caption()).contains(number(result->design.history[1].objective)));
    panel.compareButton()->click();
    QVERIFY(!viewport.pair());

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
