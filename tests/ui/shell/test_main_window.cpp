#include <QDropEvent>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "ui/panels/message_bar.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/panels/scene_tree.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using shell::MainWindow;

namespace {
const QString duffing = QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json");
const std::string mass = "/point_masses/0/mass";
constexpr int patience = 60'000;  ///< milliseconds; machines differ, and nothing here is timed
}  // namespace

/// The main job of the window, with real mouse events: open, run, drag, see the prediction, update, undo.
class TestMainWindow : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init();
  void anEmptyWindowShowsTheGallery();
  void theMainJob();
  void aCancelledCurveStaysOnScreen();
  void aBadFileLeavesTheSceneIntact();
  void undoOfANonParameterEditMakesFresh();
  void clickingTheCurveShowsThatMotion();
  void peaksShowTheirShapes();
  void anotherSceneTakesSelectionAndMotionAlong();
  void otherNodesPutTheMotionAsideUntilUndo();
  void aSliderWithoutMaximumKeepsItsEnd();
  void aMassCanBeDraggedToNothing();
  void aMissingFileIsOneSentence();
  void droppedFilesAreOpened();
  void closingEndsWhatRuns();

 private:
  void openScene();
  void runAll();
  QAction* action(const char* id) { return window_->actions().find(id); }
  QString status(const char* study) { return document::toString(window_->document().study(study)->status); }
  void picture(const char* name) {
    QCoreApplication::processEvents();
    if (qEnvironmentVariableIsSet("PLIANT_PICTURES"))
      window_->grab().save(QStringLiteral("%1/%2.png").arg(qEnvironmentVariable("PLIANT_PICTURES"), name));
  }

  std::unique_ptr<MainWindow> window_;
};

void TestMainWindow::init() {
  window_ = std::make_unique<MainWindow>(false);
  window_->resize(1280, 800);
  window_->show();
  QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
}

void TestMainWindow::openScene() {
  QSignalSpy replaced(&window_->document(), &document::Document::sceneReplaced);
  window_->openFile(duffing);
  QTRY_COMPARE_WITH_TIMEOUT(replaced.count(), 1, patience);
}

void TestMainWindow::runAll() {
  action("study.run")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!window_->session().isBusy(), patience);
  QCOMPARE(status("motion"), QString("solved"));
  QCOMPARE(status("response"), QString("solved"));
}

void TestMainWindow::anEmptyWindowShowsTheGallery() {
  QVERIFY(!action("study.run")->isEnabled());
  QVERIFY(!action("file.save")->isEnabled());
  const auto buttons = window_->findChildren<QPushButton*>();
  const auto card =
      std::find_if(buttons.begin(), buttons.end(), [](QPushButton* button) { return button->toolTip() == duffing; });
  QVERIFY(card != buttons.end());
  QSignalSpy replaced(&window_->document(), &document::Document::sceneReplaced);
  QTest::qWait(300);
  picture("gallery");
  QTest::mouseClick(*card, Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(replaced.count(), 1, patience);
  QTRY_VERIFY_WITH_TIMEOUT(!window_->session().isBusy(), patience);
}

void TestMainWindow::theMainJob() {
  openScene();
  runAll();
  jobs::MotionSession& session = window_->session();
  QVERIFY(session.shown().has_value());
  QTRY_VERIFY_WITH_TIMEOUT(!session.effects().empty(), patience);
  const double solvedBefore = session.shownAmplitude();
  picture("solved");

  auto* row = window_->parameters().row(mass);
  QVERIFY(row);
  panels::ParameterSlider* slider = row->slider();
  const QPoint start = slider->handlePosition();
  const QPoint place = slider->mapTo(window_.get(), QPoint());
  QTest::mousePress(slider, Qt::LeftButton, {}, start);
  for (int i = 1; i <= 3; ++i) QTest::mouseMove(slider, start - QPoint(i, 0));
  // While it is dragged: nothing is in the undo stack yet, and the prediction stands in viewport, plot and panel.
  QCOMPARE(window_->document().undoStack().count(), 0);
  QVERIFY(session.prediction().has_value());
  const auto marker = window_->response().plot()->prediction();
  QVERIFY(marker.has_value());
  QCOMPARE(marker->amplitude, *session.predictedAmplitude());
  QVERIFY(std::abs(marker->amplitude - solvedBefore) > 1e-6 * solvedBefore);
  QVERIFY(window_->parameters().summary().contains("predicted"));
  QCoreApplication::processEvents();
  QCOMPARE(slider->mapTo(window_.get(), QPoint()), place);  // nothing moves away under the hand
  QTest::mouseRelease(slider, Qt::LeftButton, {}, start - QPoint(3, 0));

  // Released: one step, and the prediction stays until the update.
  QCOMPARE(window_->document().undoStack().count(), 1);
  const double changed = window_->document().valueAt(mass).get<double>();
  QVERIFY(changed < 1.0);
  QVERIFY(session.prediction().has_value());
  QVERIFY(session.isStale());
  QCOMPARE(status("response"), QString("stale"));
  const double predicted = *session.predictedAmplitude();
  picture("predicted");

  QVERIFY(action("study.update")->isEnabled());
  QSignalSpy updated(&session, &jobs::MotionSession::updated);
  QTest::mouseClick(window_->parameters().updateButton(), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(updated.count(), 1, patience);
  QCOMPARE(updated[0][0].toDouble(), predicted);
  const double solvedAfter = updated[0][1].toDouble();
  // To first order the prediction is right: it is closer to the truth than keeping the old motion would be.
  QVERIFY(std::abs(predicted - solvedAfter) < std::abs(solvedBefore - solvedAfter));
  QVERIFY(window_->messages().sentence().contains("prediction was off by"));
  QVERIFY(!session.prediction().has_value());
  QVERIFY(!session.isStale());
  QTRY_VERIFY_WITH_TIMEOUT(!session.isBusy(), patience);
  QCOMPARE(status("response"), QString("solved"));
  picture("updated");

  action("edit.undo")->trigger();
  QCOMPARE(window_->document().valueAt(mass).get<double>(), 1.0);
  QCOMPARE(slider->realValue(), 1.0);
  QVERIFY(session.isStale());
  QVERIFY(!window_->document().isModified());
  action("edit.redo")->trigger();
  QCOMPARE(window_->document().valueAt(mass).get<double>(), changed);
  QVERIFY(!session.isStale());
  QCOMPARE(status("response"), QString("solved"));
}

void TestMainWindow::aCancelledCurveStaysOnScreen() {
  openScene();
  // Fine enough that there is something to cancel.
  QVERIFY(window_->document().setValue("/studies/1/maximum_step", 0.002, "Step"));
  plots::ResponsePlot* plot = window_->response().plot();
  window_->session().run({"response"});
  QTRY_VERIFY_WITH_TIMEOUT(plot->pointCount() >= 10 || status("response") == QString("solved"), patience);
  QCOMPARE(status("response"), QString("running"));
  action("study.cancel")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!window_->session().isBusy(), patience);
  QCOMPARE(status("response"), QString("cancelled"));
  QVERIFY(plot->pointCount() >= 10);
  QVERIFY(plot->statusText().contains("Cancelled"));
  picture("cancelled");
}

void TestMainWindow::aBadFileLeavesTheSceneIntact() {
  openScene();
  QVERIFY(window_->document().setValue(mass, "1.5 kg", "Mass"));
  QTemporaryDir folder;
  QFile bad(folder.filePath("bad.json"));
  QVERIFY(bad.open(QIODevice::WriteOnly));
  bad.write("{\"schema_version\": 1, \"geometri\": []}");
  bad.close();
  window_->openFile(bad.fileName());
  QTRY_VERIFY_WITH_TIMEOUT(window_->messages().sentence().contains("geometri"), patience);
  QVERIFY(window_->messages().isVisible());
  QCOMPARE(window_->document().file(), duffing);
  QCOMPARE(window_->document().valueAt(mass).get<double>(), 1.5);
  QVERIFY(window_->document().undoStack().canUndo());
}

void TestMainWindow::undoOfANonParameterEditMakesFresh() {
  openScene();
  runAll();
  QVERIFY(window_->document().setValue("/damping/mass_proportional", "0.08 1/s", "Damping"));
  QTRY_VERIFY_WITH_TIMEOUT(!window_->document().isEditing(), patience);  // another model is built beside the window
  QVERIFY(window_->session().isStale());
  QVERIFY(!window_->session().prediction().has_value());  // damping is no parameter
  QVERIFY(!window_->session().predictionObstacle().isEmpty());
  QCOMPARE(status("response"), QString("stale"));
  window_->document().undoStack().undo();
  QVERIFY(!window_->session().isStale());
  QCOMPARE(status("response"), QString("solved"));
}

void TestMainWindow::clickingTheCurveShowsThatMotion() {
  openScene();
  runAll();
  plots::ResponsePlot* plot = window_->response().plot();
  QVERIFY(plot->pointCount() > 10);
  const auto result =
      std::dynamic_pointer_cast<const scene::HarmonicResult>(window_->document().study("response")->result);
  const auto& point = result->points[5];
  const QPoint place = plot->positionOf({point.omega, point.amplitudes[0].pathLength}).toPoint();
  QWidget* canvas = plot->childAt(place);
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->mapFrom(plot, place));
  QCOMPARE(window_->session().shown()->study, std::string("response"));
  QVERIFY(std::abs(window_->session().shown()->motion.omega - point.omega) < 0.02);
  // Its sensitivity comes behind it.
  QTRY_VERIFY_WITH_TIMEOUT(!window_->session().effects().empty(), patience);
}

void TestMainWindow::peaksShowTheirShapes() {
  openScene();
  runAll();
  plots::ResponsePlot* plot = window_->response().plot();
  QCOMPARE(plot->visibleInsets(), 0);
  const auto actions = window_->response().findChildren<QAction*>();
  const auto shapes =
      std::find_if(actions.begin(), actions.end(), [](const QAction* a) { return a->text().contains("shapes"); });
  QVERIFY(shapes != actions.end());
  (*shapes)->trigger();
  picture("peaks");
  QTRY_COMPARE(plot->visibleInsets(), 1);
  (*shapes)->trigger();
  QTRY_COMPARE(plot->visibleInsets(), 0);
}

void TestMainWindow::anotherSceneTakesSelectionAndMotionAlong() {
  const QString chain = QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/spring_chain.json");
  QSignalSpy replaced(&window_->document(), &document::Document::sceneReplaced);
  window_->openFile(chain);
  QTRY_COMPARE_WITH_TIMEOUT(replaced.count(), 1, patience);
  window_->session().run({"response"});
  QTRY_VERIFY_WITH_TIMEOUT(!window_->session().isBusy() && window_->session().shown(), patience);
  const int last = window_->document().model()->nodeCount() - 1;
  window_->session().selectNode(last);
  QCOMPARE(window_->session().node(), last);
  // A solve is under way when another scene comes: what it finds is not about that scene.
  window_->session().solveAt(1.1 * window_->session().shown()->motion.omega, "response", 0);
  QVERIFY(window_->document().open(duffing));
  const auto model = window_->document().model();
  QCOMPARE(window_->session().node(), model->probes.front().node);
  QVERIFY(!window_->session().shown().has_value());
  QTest::qWait(300);
  QVERIFY(!window_->session().shown().has_value());
  QCOMPARE(window_->session().node(), model->probes.front().node);
  QCOMPARE(window_->viewport().selectedNode().value_or(-1), window_->session().node());
}

void TestMainWindow::otherNodesPutTheMotionAsideUntilUndo() {
  const QString strip = QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/membrane_strip.json");
  QSignalSpy replaced(&window_->document(), &document::Document::sceneReplaced);
  window_->openFile(strip);
  QTRY_COMPARE_WITH_TIMEOUT(replaced.count(), 1, patience);
  jobs::MotionSession& session = window_->session();
  session.run({"motion"});
  QTRY_VERIFY_WITH_TIMEOUT(!session.isBusy() && session.shown(), patience);
  const double amplitude = session.shownAmplitude();
  const auto probe = [&] { return window_->document().model()->probes.front(); };
  QCOMPARE(session.node(), probe().node);
  const int before = session.node();

  const auto cells = window_->document().valueAt("/geometry/0/length_cells").get<int>();
  QVERIFY(window_->document().setValue("/geometry/0/length_cells", 2 * cells, "Cells"));
  QVERIFY(window_->document().isEditing());
  QVERIFY(!action("study.run")->isEnabled());
  QTRY_VERIFY_WITH_TIMEOUT(!window_->document().isEditing(), patience);
  // The probe has another number by now, and stays the one that is selected.
  QVERIFY(probe().node != before);
  QCOMPARE(session.node(), probe().node);
  QCOMPARE(window_->viewport().selectedNode().value_or(-1), session.node());
  QVERIFY(!session.shown().has_value());

  action("edit.undo")->trigger();
  QCOMPARE(session.node(), before);
  QVERIFY(session.shown().has_value());
  QVERIFY(!session.isStale());
  QCOMPARE(session.shownAmplitude(), amplitude);
}

void TestMainWindow::aSliderWithoutMaximumKeepsItsEnd() {
  openScene();
  document::Document& document = window_->document();
  QVERIFY(!document.scene().json().at("point_masses")[0].contains("maximum"));
  const auto end = [&] { return window_->parameters().row(mass)->slider()->realMaximum(); };
  QCOMPARE(end(), 5.0);
  QVERIFY(document.setValue(mass, "3 kg", "Mass"));
  QCOMPARE(end(), 5.0);
  QVERIFY(document.setValue("/damping/mass_proportional", "0.08 1/s", "Damping"));
  QTRY_VERIFY_WITH_TIMEOUT(!document.isEditing(), patience);
  QCOMPARE(end(), 5.0);
  // A second mass makes all rows anew.
  window_->sceneTree().addEntry("point_masses", "point_mass");
  QTRY_VERIFY_WITH_TIMEOUT(!document.isEditing(), patience);
  QVERIFY(window_->parameters().row("/point_masses/1/mass"));
  QCOMPARE(end(), 5.0);
  // Only what lies beyond moves it, and what the scene says.
  QVERIFY(document.setValue(mass, "8 kg", "Mass"));
  QCOMPARE(end(), 40.0);
  document.undoStack().undo();
  QCOMPARE(end(), 40.0);
  QVERIFY(document.setValue("/point_masses/0/maximum", "6 kg", "Maximum"));
  QTRY_VERIFY_WITH_TIMEOUT(!document.isEditing(), patience);
  QCOMPARE(end(), 6.0);
}

void TestMainWindow::aMassCanBeDraggedToNothing() {
  QSignalSpy replaced(&window_->document(), &document::Document::sceneReplaced);
  window_->openFile(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/membrane_strip.json"));
  QTRY_COMPARE_WITH_TIMEOUT(replaced.count(), 1, patience);
  document::Document& document = window_->document();
  scene::Json entry = document.scene().json().at("point_masses")[0];
  entry.erase("maximum");
  QVERIFY(document.setValue("/point_masses/0", entry, "No maximum"));
  QTRY_VERIFY_WITH_TIMEOUT(!document.isEditing(), patience);
  auto* slider = window_->parameters().row(mass)->slider();
  const double end = slider->realMaximum();
  QTest::keyClick(slider, Qt::Key_Home);
  QTRY_VERIFY_WITH_TIMEOUT(!document.isEditing(), patience);
  QCOMPARE(document.valueAt(mass).get<double>(), 0.0);
  QCOMPARE(window_->parameters().row(mass)->slider()->realMaximum(), end);
  document.undoStack().undo();
  QVERIFY(document.valueAt(mass).get<double>() > 0);
}

void TestMainWindow::aMissingFileIsOneSentence() {
  window_->openFile("/no/such/folder/scene.json");
  QTRY_VERIFY_WITH_TIMEOUT(window_->messages().isVisible(), patience);
  const QString sentence = window_->messages().sentence();
  QVERIFY2(sentence.contains("/no/such/folder/scene.json") && sentence.endsWith('.'), qPrintable(sentence));
  QCOMPARE(sentence.count('\n'), 0);
  QVERIFY(window_->document().isEmpty());
  QVERIFY(!action("study.run")->isEnabled());
}

void TestMainWindow::droppedFilesAreOpened() {
  QSignalSpy replaced(&window_->document(), &document::Document::sceneReplaced);
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(duffing)});
  QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &drop);
  QTRY_COMPARE_WITH_TIMEOUT(replaced.count(), 1, patience);
  QCOMPARE(window_->document().file(), duffing);
}

void TestMainWindow::closingEndsWhatRuns() {
  openScene();
  QVERIFY(window_->document().setValue("/studies/1/maximum_step", 0.002, "Step"));
  window_->session().run({"response"});
  QTRY_VERIFY_WITH_TIMEOUT(window_->response().plot()->pointCount() >= 5, patience);
  QCOMPARE(status("response"), QString("running"));
  QVERIFY(window_->close());
  window_.reset();
  QCoreApplication::processEvents();
}

QTEST_MAIN(TestMainWindow)
#include "test_main_window.moc"
